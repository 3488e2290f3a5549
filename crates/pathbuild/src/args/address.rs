//! Address of `watch --serve`.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};

/// An address of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Address {
    /// Name or IP address.
    pub host: Host,
    /// Port; `None` means the default port, or a free one if that is taken.
    pub port: Option<u16>,
}

/// A name or an IP address of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "self-explanatory")]
pub enum Host {
    Ip(IpAddr),
    Name(String),
}

impl Address {
    /// The loopback address, which only this machine can reach.
    pub const LOOPBACK: Self = Self { host: Host::Ip(IpAddr::V4(Ipv4Addr::LOCALHOST)), port: None };

    /// Parses `8080`, `127.0.0.1`, `[::1]:8080`, `localhost` or `name:8080`. Another name without a port is refused, because it could as
    /// well be a path or a directory.
    ///
    /// # Errors
    /// What is accepted.
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

/// Whether the text can be a host name.
fn is_name(text: &str) -> bool {
    let is_part = |part: &str| {
        !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'-')
    };
    text.split('.').all(is_part)
}
