//! The address on which the server listens, the host names that it accepts, and the checks of requests.

use std::convert::Infallible;
use std::io;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, TcpListener, ToSocketAddrs, UdpSocket};
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::http::header::{self, HeaderMap, HeaderValue};
use axum::http::request::Parts;
use axum::http::{Method, StatusCode};
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::net::TcpStream;
use tokio::sync::Semaphore;
use tokio::time::sleep;

use crate::args::{Address, Host};

pub(super) const DEFAULT_PORT: u16 = 8347;

/// The address of a listening socket, and the requirements for requests to it.
pub(super) struct Endpoint {
    /// Host that was requested on the command line.
    host: Host,
    local: SocketAddr,
    /// Secret that pages must present; `None` if only this machine can connect, so that none is needed.
    token: Option<String>,
}

impl Endpoint {
    /// Starts listening.
    ///
    /// # Errors
    /// The reason why the address cannot be used.
    pub(super) fn open(address: &Address) -> io::Result<(TcpListener, Self)> {
        let listener = match address.port {
            Some(port) => bind(&address.host, port)?,
            None => match bind(&address.host, DEFAULT_PORT) {
                Err(error) if error.kind() == io::ErrorKind::AddrInUse => bind(&address.host, 0)?,
                other => other?,
            },
        };
        listener.set_nonblocking(true)?;
        let local = listener.local_addr()?;
        let token = if local.ip().is_loopback() { None } else { Some(random_token()?) };
        Ok((listener, Self { host: address.host.clone(), local, token }))
    }

    pub(super) fn port(&self) -> u16 {
        self.local.port()
    }

    pub(super) fn token(&self) -> Option<&str> {
        self.token.as_deref()
    }

    /// Returns the URL for a browser. The token is in the fragment, which browsers send to no server and no proxy.
    pub(super) fn link(&self) -> String {
        let host = match &self.host {
            Host::Name(name) => name.clone(),
            Host::Ip(ip) if ip.is_unspecified() => url_address(own_address(*ip)),
            Host::Ip(ip) => url_address(*ip),
        };
        let fragment = self.token.as_ref().map(|token| format!("#token={token}")).unwrap_or_default();
        format!("http://{host}:{}/{fragment}", self.port())
    }

    /// Whether `authority` in a `Host` header refers to this server. Other names must be refused, because their owners could let them
    /// point to this server, and pages of their sites could then read everything (DNS rebinding).
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
            Host::Ip(ip) if ip.is_unspecified() => is_ip_address(host),
            Host::Ip(ip) => url_address(*ip) == host,
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

/// Formats an IP address for a URL.
fn url_address(ip: IpAddr) -> String {
    match ip {
        IpAddr::V4(ip) => ip.to_string(),
        IpAddr::V6(ip) => format!("[{ip}]"),
    }
}

/// Whether a host is an IP address, which DNS cannot redirect.
fn is_ip_address(host: &str) -> bool {
    let inner = host.strip_prefix('[').and_then(|host| host.strip_suffix(']'));
    inner.map_or_else(|| host.parse::<Ipv4Addr>().is_ok(), |host| host.parse::<Ipv6Addr>().is_ok())
}

/// Returns the address by which other machines reach this one if the server listens on all addresses. Nothing is sent to determine it.
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

/// Returns a random number of 128 bits in hexadecimal.
pub(super) fn random_token() -> io::Result<String> {
    let mut bits = [0; 16];
    getrandom::fill(&mut bits).map_err(io::Error::other)?;
    Ok(format!("{:032x}", u128::from_ne_bytes(bits)))
}

/// Prefix of the routes that return data, for which the token is required.
pub(super) const DATA_PREFIX: &str = "/api/";

/// Route that receives the text of a program, which the server does not store.
pub(super) const PROGRAM_ROUTE: &str = "/api/program";

/// Returns the method that a route accepts.
pub(super) fn method(path: &str) -> Method {
    if path == PROGRAM_ROUTE { Method::POST } else { Method::GET }
}

/// Decides whether a request is answered.
///
/// # Errors
/// The status with which the request is refused.
pub(super) fn admit(endpoint: &Endpoint, request: &Parts) -> Result<(), StatusCode> {
    if request.method != method(request.uri.path()) {
        return Err(StatusCode::METHOD_NOT_ALLOWED);
    }
    let is_called_rightly = match single(&request.headers, header::HOST) {
        SingleHeader::One(host) => endpoint.answers_to(host),
        SingleHeader::None | SingleHeader::Other => false,
    };
    // The request line may name another server than the `Host` header.
    let is_meant = request.uri.authority().is_none_or(|authority| endpoint.answers_to(authority.as_str()));
    if !is_called_rightly || !is_meant {
        return Err(StatusCode::MISDIRECTED_REQUEST);
    }
    let is_own = match single(&request.headers, header::ORIGIN) {
        SingleHeader::None => true,
        SingleHeader::One(origin) => {
            origin.strip_prefix("http://").is_some_and(|origin| endpoint.answers_to(origin))
        }
        SingleHeader::Other => false,
    };
    if !is_own {
        return Err(StatusCode::FORBIDDEN);
    }
    match endpoint.token() {
        Some(token) if request.uri.path().starts_with(DATA_PREFIX) && !has_token(&request.headers, token) => {
            Err(StatusCode::UNAUTHORIZED)
        }
        _ => Ok(()),
    }
}

/// Whether a request presents the token. Hashes are compared, so that timing reveals nothing about the token.
fn has_token(headers: &HeaderMap, token: &str) -> bool {
    let SingleHeader::One(given) = single(headers, header::AUTHORIZATION) else { return false };
    let Some(given) = given.strip_prefix("Bearer ") else { return false };
    blake3::hash(given.as_bytes()) == blake3::hash(token.as_bytes())
}

/// The value of a header that may occur only once.
enum SingleHeader<'a> {
    None,
    One(&'a str),
    /// There are several values, or the value is not text.
    Other,
}

fn single(headers: &HeaderMap, name: header::HeaderName) -> SingleHeader<'_> {
    let mut values = headers.get_all(name).iter().map(HeaderValue::to_str);
    match (values.next(), values.next()) {
        (None, _) => SingleHeader::None,
        (Some(Ok(value)), None) => SingleHeader::One(value),
        _ => SingleHeader::Other,
    }
}

/// Headers of every response. They ensure that nothing is loaded from elsewhere, that nothing is cached, and that no other page can embed
/// this one.
pub(super) const HEADERS: [(header::HeaderName, &str); 5] = [
    (
        header::CONTENT_SECURITY_POLICY,
        "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    ),
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (header::HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
    (header::REFERRER_POLICY, "no-referrer"),
    (header::CACHE_CONTROL, "no-store"),
];

/// Maximum number of concurrent connections; further ones wait. A page uses two, and briefly a third.
const MAX_CONNECTIONS: usize = 256;

/// Time within which a connection must send its request. Responses, such as the event stream, may take longer.
const REQUEST_TIMEOUT: Duration = Duration::from_secs(10);

/// Pause after a system error, such as too many open files, before the next connection is accepted.
const ERROR_PAUSE: Duration = Duration::from_secs(1);

/// Accepts and serves connections forever.
pub(super) async fn answer(listener: tokio::net::TcpListener, router: Router) -> Infallible {
    let free = Arc::new(Semaphore::new(MAX_CONNECTIONS));
    loop {
        // The semaphore is never closed, so waiting for a permit cannot fail.
        let permit = Arc::clone(&free).acquire_owned().await.ok();
        let stream = accept_connection(&listener).await;
        let router = router.clone();
        tokio::spawn(async move {
            let _permit = permit;
            let mut http = http1::Builder::new();
            http.timer(TokioTimer::new()).header_read_timeout(REQUEST_TIMEOUT);
            // A malformed or missing request is answered by closing the connection.
            _ = http.serve_connection(TokioIo::new(stream), TowerToHyperService::new(router)).await;
        });
    }
}

/// Returns the next connection. Errors do not end the server: it tries again, after a pause if the connection is not the cause.
async fn accept_connection(listener: &tokio::net::TcpListener) -> TcpStream {
    loop {
        match listener.accept().await {
            Ok((stream, _)) => return stream,
            Err(error) if is_gone(&error) => {}
            Err(_) => sleep(ERROR_PAUSE).await,
        }
    }
}

/// Whether the connection ended before it was accepted.
fn is_gone(error: &io::Error) -> bool {
    use io::ErrorKind::{ConnectionAborted, ConnectionRefused, ConnectionReset};

    matches!(error.kind(), ConnectionAborted | ConnectionRefused | ConnectionReset)
}
