//! Where `watch --serve` is to be found.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};

/// An address of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Address {
    /// Which of its names or addresses.
    pub host: Host,
    /// `None`: the usual one, or a free one where that is taken.
    pub port: Option<u16>,
}

/// A name or an address of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Host {
    Ip(IpAddr),
    Name(String),
}

impl Address {
    /// Where nobody but this machine comes to.
    pub const LOOPBACK: Self = Self { host: Host::Ip(IpAddr::V4(Ipv4Addr::LOCALHOST)), port: None };

    /// Reads `8080`, `127.0.0.1`, `[::1]:8080`, `localhost` or `name:8080`. A name alone could as well be a path or a directory.
    ///
    /// # Errors
    /// What it should be.
    pub fn parse(text: &str) -> Result<Self, String> {
        if let Ok(port) = text.parse() {
            return Ok(Self { port: Some(port), ..Self::LOOPBACK });
        }
        if let Ok(address) = text.parse::<SocketAddr>() {
            return Ok(Self { host: Host::Ip(address.ip()), port: Some(address.port()) });
        }
        let bare = text.strip_prefix('[').and_then(|text| text.strip_suffix(']')).unwrap_or(text);
        if let Ok(ip) = bare.parse() {
            return Ok(Self { host: Host::Ip(ip), port: None });
        }
        let (name, port) = text.rsplit_once(':').map_or((text, None), |(name, port)| (name, Some(port)));
        let is_meant = port.is_some() || name.eq_ignore_ascii_case("localhost");
        let port: Option<u16> = port.map(str::parse).transpose().map_err(|_| ADVICE)?;
        if !is_meant || !is_name(name) {
            return Err(ADVICE.to_owned());
        }
        Ok(Self { host: Host::Name(name.to_ascii_lowercase()), port })
    }
}

const ADVICE: &str = "an address is PORT, IP, IP:PORT, localhost or NAME:PORT (drawings, paths and directories stand before --serve)";

/// Whether it can be the name of a machine.
fn is_name(text: &str) -> bool {
    let is_part = |part: &str| {
        !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'-')
    };
    text.split('.').all(is_part)
}
