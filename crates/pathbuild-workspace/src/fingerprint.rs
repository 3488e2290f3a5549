//! Fingerprints of findings: the same finding has the same one in every run, language and version.

use std::collections::BTreeMap;
use std::fmt;

use pathbuild_diagnostic::Diagnostic;

/// A 128-bit hash that identifies a finding, displayed as 32 hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Fingerprint(u128);

impl Fingerprint {
    /// Fingerprints of findings, in their order.
    pub fn of(diagnostics: &[Diagnostic]) -> Vec<Self> {
        let mut met: BTreeMap<u128, u32> = BTreeMap::new();
        let mut fingerprint = |diagnostic| {
            let hash = hash(diagnostic);
            let number = met.entry(hash.0).and_modify(|number| *number += 1).or_insert(0);
            Self(hash.and(&number.to_le_bytes()).0)
        };
        diagnostics.iter().map(&mut fingerprint).collect()
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

fn hash(diagnostic: &Diagnostic) -> Hash {
    let place = &diagnostic.place;
    let point = place.point.map(|point| format!("{:.3} {:.3}", point.x.0 + 0.0, point.y.0 + 0.0));
    let fault = diagnostic.text.as_ref().map(|fault| &fault.text[fault.span()]);
    Hash::NEW
        .and(diagnostic.code().to_string().as_bytes())
        .and(diagnostic.file.as_ref().and_then(|file| file.file_name()).unwrap_or_default().as_bytes())
        .and(diagnostic.path.as_deref().unwrap_or_default().to_uppercase().as_bytes())
        .and(place.entity.map_or("", |entity| entity.name()).as_bytes())
        .and(point.unwrap_or_default().as_bytes())
        .and(fault.unwrap_or_default().as_bytes())
}

/// 128-bit FNV-1a, which is the same on every machine and in every version.
#[derive(Clone, Copy)]
struct Hash(u128);

impl Hash {
    const NEW: Self = Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d);
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

    /// Adds bytes, followed by a separator that does not occur in UTF-8.
    fn and(self, bytes: &[u8]) -> Self {
        bytes
            .iter()
            .chain(&[0xff])
            .fold(self, |hash, byte| Self((hash.0 ^ u128::from(*byte)).wrapping_mul(Self::PRIME)))
    }
}
