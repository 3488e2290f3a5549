//! Address on which the server listens, and the names by which it may be called.

use std::io;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, TcpListener, ToSocketAddrs, UdpSocket};

use crate::args::{Address, Host};

/// Default port.
pub(super) const PORT: u16 = 8347;

/// A listening socket with the names it answers to.
pub(super) struct Endpoint {
    /// The host that was requested.
    host: Host,
    local: SocketAddr,
    /// Secret that pages must present; `None` if only this machine can connect.
    token: Option<String>,
}

impl Endpoint {
    /// Starts listening.
    ///
    /// # Errors
    /// Why the address cannot be used.
    pub(super) fn open(address: &Address) -> io::Result<(TcpListener, Self)> {
        let listener = match address.port {
            Some(port) => bind(&address.host, port)?,
            None => match bind(&address.host, PORT) {
                Err(error) if error.kind() == io::ErrorKind::AddrInUse => bind(&address.host, 0)?,
                other => other?,
            },
        };
        listener.set_nonblocking(true)?;
        let local = listener.local_addr()?;
        let token = if local.ip().is_loopback() { None } else { Some(random()?) };
        Ok((listener, Self { host: address.host.clone(), local, token }))
    }

    pub(super) fn port(&self) -> u16 {
        self.local.port()
    }

    pub(super) fn token(&self) -> Option<&str> {
        self.token.as_deref()
    }

    /// The URL for a browser. The token is in the fragment, which browsers send to no server and no proxy.
    pub(super) fn link(&self) -> String {
        let host = match &self.host {
            Host::Name(name) => name.clone(),
            Host::Ip(ip) if ip.is_unspecified() => literal(own_address(*ip)),
            Host::Ip(ip) => literal(*ip),
        };
        let fragment = self.token.as_ref().map(|token| format!("#token={token}")).unwrap_or_default();
        format!("http://{host}:{}/{fragment}", self.port())
    }

    /// Whether `authority` in a `Host` header means this server. Other names must be refused: whoever controls such a name could point it
    /// here, and pages from there would be allowed to read everything (DNS rebinding).
    pub(super) fn answers_to(&self, authority: &str) -> bool {
        let authority = authority.to_ascii_lowercase();
        let suffix = format!(":{}", self.port());
        let host = match authority.strip_suffix(&suffix) {
            Some(host) => host,
            None if self.port() == 80 => &authority,
            None => return false,
        };
        let is_own = match &self.host {
            Host::Name(name) => name == host,
            Host::Ip(ip) if ip.is_unspecified() => is_literal(host),
            Host::Ip(ip) => literal(*ip) == host,
        };
        is_own || matches!(host, "localhost" | "127.0.0.1" | "[::1]")
    }
}

fn bind(host: &Host, port: u16) -> io::Result<TcpListener> {
    match host {
        Host::Ip(ip) => TcpListener::bind((*ip, port)),
        Host::Name(name) => {
            let addresses: Vec<SocketAddr> = (name.as_str(), port).to_socket_addrs()?.collect();
            TcpListener::bind(&*addresses)
        }
    }
}

/// Formats an address for a URL.
fn literal(ip: IpAddr) -> String {
    match ip {
        IpAddr::V4(ip) => ip.to_string(),
        IpAddr::V6(ip) => format!("[{ip}]"),
    }
}

/// Whether the host is an IP address, which cannot be redirected by DNS.
fn is_literal(host: &str) -> bool {
    let inner = host.strip_prefix('[').and_then(|host| host.strip_suffix(']'));
    inner.map_or_else(|| host.parse::<Ipv4Addr>().is_ok(), |host| host.parse::<Ipv6Addr>().is_ok())
}

/// The address by which others reach this machine if it listens on all addresses. Sends nothing.
fn own_address(unspecified: IpAddr) -> IpAddr {
    let (from, to, loopback): (_, SocketAddr, IpAddr) = match unspecified {
        IpAddr::V4(_) => (unspecified, (Ipv4Addr::new(192, 0, 2, 1), 9).into(), Ipv4Addr::LOCALHOST.into()),
        IpAddr::V6(_) => {
            let documentation = Ipv6Addr::new(0x2001, 0xdb8, 0, 0, 0, 0, 0, 1);
            (unspecified, (documentation, 9).into(), Ipv6Addr::LOCALHOST.into())
        }
    };
    let route = || {
        let socket = UdpSocket::bind((from, 0)).ok()?;
        socket.connect(to).ok()?;
        Some(socket.local_addr().ok()?.ip())
    };
    route().unwrap_or(loopback)
}

/// A random number of 128 bits in hexadecimal.
pub(super) fn random() -> io::Result<String> {
    use std::fmt::Write;

    let mut bits = [0; 16];
    getrandom::fill(&mut bits).map_err(io::Error::other)?;
    Ok(bits.iter().fold(String::new(), |mut text, byte| {
        _ = write!(text, "{byte:02x}");
        text
    }))
}
