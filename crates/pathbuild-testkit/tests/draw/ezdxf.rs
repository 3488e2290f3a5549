//! Audits the files with ezdxf, which must find no errors and need no repairs.

use std::path::Path;
use std::process::Command;

use pathbuild_testkit::generate::library;
use pathbuild_testkit::{Version, sheet, skip};

use crate::placement::PART;

const EXAMPLES: &str = r#"
layer "Länge ~1" DASHED frozen
line BYLAYER 1,2,3 4,5,6 mirrored
arc centre 10,5 r 5 from 20 to 60 mirrored
text 0,0 "größe ^I %%c" align centre
polyline heavy 0,0 10,0 bulge -0.5 10,10 mirrored
polyline 0,0 10,0 bulge -0.5 10,10 closed
polyline spatial 0,0,1 10,0,2
linetype "Mein Typ" 5 -1 0 -1
line "Mein Typ" 0,0 9,9
solid 0,0 1,0 1,1
block B base 1,1
layer 0
line 1,1 3,1
polyline heavy 0,0 1,1
endblock
insert B at 20,30 scale 2,-2 rotate 90 columns 3 10 rows 2 5
"#;

const LATER: &str = r#"
mtext 1,2 "größe \S1^ 2;\PO2" align bottom right rotate 45
mtext 1,2 "abcdefghij" chunks 3 direction 0,1
ellipse centre 0,0 major 10,0 ratio 0.5 from 0 to 90
spline control 0,0 1,1 2,0 3,1 4,4
spline fit 0,0 1,1 2,0
circle 0,0 d 9 paper
"#;

/// Returns a Python with ezdxf: the one given by `PATHBUILD_EZDXF`, or python3.
#[expect(clippy::disallowed_methods, reason = "where an oracle is")]
fn python() -> Option<String> {
    let python = std::env::var("PATHBUILD_EZDXF").unwrap_or_else(|_| "python3".to_owned());
    let has_it =
        Command::new(&python).args(["-c", "import ezdxf"]).output().is_ok_and(|out| out.status.success());
    if has_it {
        return Some(python);
    }
    skip("ezdxf", &format!("{python} has no ezdxf"));
    None
}

#[test]
fn an_audit_finds_nothing_to_repair() {
    let Some(python) = python() else { return };
    let directory = tempfile::tempdir().unwrap();
    let mut files = Vec::new();
    let mut write = |name: String, bytes: Vec<u8>| {
        let path = directory.path().join(name.replace('/', "_"));
        #[expect(clippy::disallowed_methods, reason = "a test's own files")]
        std::fs::write(&path, bytes).unwrap();
        files.push(path);
    };
    for version in Version::ALL {
        let name = version.name();
        let later = if version < Version::R13 { "" } else { LATER };
        let sheet = sheet(&format!("version {name}\nfurniture 5\n{PART}{EXAMPLES}{later}")).unwrap();
        write(format!("{name}.dxf"), sheet.to_dxf());
        write(format!("{name} binary.dxf"), sheet.to_binary_dxf());
    }
    for (name, sheet) in library(50, 9) {
        write(name, sheet.to_dxf());
    }
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/draw/audit.py");
    let audit = Command::new(python).arg(script).args(&files).output().unwrap();
    let said = String::from_utf8_lossy(&audit.stdout).into_owned() + &String::from_utf8_lossy(&audit.stderr);
    assert!(audit.status.success(), "{said}");
    assert_eq!(said.matches(" entities").count(), files.len(), "{said}");
}
