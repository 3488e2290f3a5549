//! Connections: so many at a time, and none that says nothing.

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

/// So many are answered at a time; others wait until one ends. A page has two, and a third one for a moment.
const MOST: usize = 256;

/// So long a connection may take to ask, at its beginning and after each answer. An answer may take longer, as that of events does.
const SILENCE: Duration = Duration::from_secs(10);

/// After an error of the system, which has no room for another connection perhaps.
const PAUSE: Duration = Duration::from_secs(1);

/// Answers whoever comes, for ever.
pub(super) async fn answer(listener: TcpListener, router: Router) -> Infallible {
    let free = Arc::new(Semaphore::new(MOST));
    loop {
        // Nobody closes the semaphore: there is always a permit to wait for.
        let permit = Arc::clone(&free).acquire_owned().await.ok();
        let stream = next(&listener).await;
        let router = router.clone();
        tokio::spawn(async move {
            let _permit = permit;
            let mut http = http1::Builder::new();
            http.timer(TokioTimer::new()).header_read_timeout(SILENCE);
            // Who asks wrongly, or says nothing, is told by the end of the connection.
            _ = http.serve_connection(TokioIo::new(stream), TowerToHyperService::new(router)).await;
        });
    }
}

/// The next connection.
async fn next(listener: &TcpListener) -> TcpStream {
    loop {
        match listener.accept().await {
            Ok((stream, _)) => return stream,
            Err(error) if is_gone(&error) => {}
            Err(_) => sleep(PAUSE).await,
        }
    }
}

/// Whether it ended before it was taken.
fn is_gone(error: &io::Error) -> bool {
    use io::ErrorKind::{ConnectionAborted, ConnectionRefused, ConnectionReset};

    matches!(error.kind(), ConnectionAborted | ConnectionRefused | ConnectionReset)
}
