//! Accepts connections, limited in number and in idle time.

use std::convert::Infallible;
use std::io;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Semaphore;
use tokio::time::sleep;

/// Upper bound on concurrent connections; further ones wait. A page uses two, and briefly a third.
const MOST: usize = 256;

/// Time that a connection may take to send a request. Responses, such as the event stream, may take longer.
const SILENCE: Duration = Duration::from_secs(10);

/// Pause after a system error, such as too many open files.
const PAUSE: Duration = Duration::from_secs(1);

/// Accepts and serves connections forever.
pub(super) async fn answer(listener: TcpListener, router: Router) -> Infallible {
    let free = Arc::new(Semaphore::new(MOST));
    loop {
        // The semaphore is never closed, so a permit is always available eventually.
        let permit = Arc::clone(&free).acquire_owned().await.ok();
        let stream = next(&listener).await;
        let router = router.clone();
        tokio::spawn(async move {
            let _permit = permit;
            let mut http = http1::Builder::new();
            http.timer(TokioTimer::new()).header_read_timeout(SILENCE);
            // Malformed or missing requests are answered by closing the connection.
            _ = http.serve_connection(TokioIo::new(stream), TowerToHyperService::new(router)).await;
        });
    }
}

/// Accepts the next connection.
async fn next(listener: &TcpListener) -> TcpStream {
    loop {
        match listener.accept().await {
            Ok((stream, _)) => return stream,
            Err(error) if is_gone(&error) => {}
            Err(_) => sleep(PAUSE).await,
        }
    }
}

/// Whether the connection ended before it was accepted.
fn is_gone(error: &io::Error) -> bool {
    use io::ErrorKind::{ConnectionAborted, ConnectionRefused, ConnectionReset};

    matches!(error.kind(), ConnectionAborted | ConnectionRefused | ConnectionReset)
}
