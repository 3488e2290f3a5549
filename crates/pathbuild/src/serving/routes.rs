//! The routes of the server: the page, its data and its events.

use std::convert::Infallible;
use std::io;
use std::net::TcpListener;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::body::Bytes;
use axum::extract::{DefaultBodyLimit, Query, Request, State};
use axum::http::header::{CONTENT_TYPE, HeaderValue};
use axum::http::{StatusCode, header};
use axum::middleware::{self, Next};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use futures_util::stream;
use pathbuild_diagnostic::{Lang, escaping};
use pathbuild_workspace::program_view::{Assumptions, DroppedProgram};
use serde::Deserialize;
use tokio::runtime;
use tokio::sync::watch;
use tokio::time::timeout;

use super::endpoint::{Endpoint, HEADERS, PROGRAM_ROUTE, admit, answer, method, random_token};
use super::hub::{AnswerForm, Hub, Subject};

/// State that all routes share.
pub(super) struct Routes {
    endpoint: Endpoint,
    hub: Arc<Hub>,
    lang: Lang,
    /// Random identifier of this run of the server. Pages of an earlier run reload everything.
    run: String,
    /// Number of open pages.
    pages: watch::Sender<usize>,
}

/// Time within which a page must reconnect, for example after it was reloaded, before it is considered closed.
const RECONNECT_TIMEOUT: Duration = Duration::from_secs(5);

/// Time that a browser may take to start before the page is considered closed.
const BROWSER_START_TIMEOUT: Duration = Duration::from_secs(90);

impl Routes {
    /// Creates the routes.
    ///
    /// # Errors
    /// The system provides no random numbers.
    pub(super) fn new(endpoint: Endpoint, hub: Arc<Hub>, lang: Lang) -> Result<Self, String> {
        let run = random_token().map_err(|error| error.to_string())?;
        Ok(Self { endpoint, hub, lang, run, pages: watch::Sender::new(0) })
    }

    /// Serves requests until the program ends.
    pub(super) fn run(self, listener: TcpListener, until_closed: bool) {
        let Ok(runtime) = runtime::Builder::new_current_thread().enable_all().build() else {
            return self.hub.end();
        };
        let hub = Arc::clone(&self.hub);
        let served = runtime.block_on(async {
            let listener = tokio::net::TcpListener::from_std(listener)?;
            tokio::spawn(end_on_ctrl_c(Arc::clone(&self.hub)));
            if until_closed {
                tokio::spawn(end_without_pages(Arc::clone(&self.hub), self.pages.subscribe()));
            }
            Ok::<_, io::Error>(answer(listener, router(Arc::new(self))).await)
        });
        if served.is_err() {
            hub.end();
        }
    }
}

/// Ends watching on the first Ctrl+C, and the process on the second one.
async fn end_on_ctrl_c(hub: Arc<Hub>) {
    if tokio::signal::ctrl_c().await.is_ok() {
        hub.end();
        _ = tokio::signal::ctrl_c().await;
        std::process::exit(130);
    }
}

/// Ends watching once no page has been open for a while.
async fn end_without_pages(hub: Arc<Hub>, mut pages: watch::Receiver<usize>) {
    let mut patience = BROWSER_START_TIMEOUT;
    while timeout(patience, pages.wait_for(|open| *open > 0)).await.is_ok_and(|open| open.is_ok()) {
        patience = RECONNECT_TIMEOUT;
        if pages.wait_for(|open| *open == 0).await.is_err() {
            break;
        }
    }
    hub.end();
}

fn router(routes: Arc<Routes>) -> Router {
    Router::new()
        .route("/", get(page))
        .route("/page.css", get(async || file("text/css; charset=utf-8", pathbuild_view::LIVE_STYLE)))
        .route("/page.js", get(async || file("text/javascript; charset=utf-8", pathbuild_view::SCRIPT)))
        .route("/api/library", get(library))
        .route("/api/scene", get(scene))
        .route("/api/picture", get(picture))
        .route("/api/events", get(events))
        .route(PROGRAM_ROUTE, post(program).layer(DefaultBodyLimit::max(MAX_PROGRAM_BYTES)))
        .layer(middleware::from_fn_with_state(Arc::clone(&routes), admit_and_secure))
        .with_state(routes)
}

/// Refuses requests that are not admitted, and adds the security headers to every response.
async fn admit_and_secure(State(routes): State<Arc<Routes>>, request: Request, next: Next) -> Response {
    let (parts, body) = request.into_parts();
    let allowed = method(parts.uri.path()).to_string();
    let mut response = match admit(&routes.endpoint, &parts) {
        Ok(()) => next.run(Request::from_parts(parts, body)).await,
        Err(StatusCode::METHOD_NOT_ALLOWED) => {
            (StatusCode::METHOD_NOT_ALLOWED, [(header::ALLOW, allowed)]).into_response()
        }
        Err(status) => status.into_response(),
    };
    for (name, value) in HEADERS {
        response.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    response
}

async fn page(State(routes): State<Arc<Routes>>) -> impl IntoResponse {
    ([(CONTENT_TYPE, "text/html; charset=utf-8")], pathbuild_view::live_page(routes.lang))
}

fn file(kind: &'static str, text: &'static str) -> impl IntoResponse {
    ([(CONTENT_TYPE, kind)], text)
}

#[derive(Deserialize)]
struct ChangesQuery {
    /// Number of the last change that the page knows; 0 if it knows none.
    #[serde(default)]
    since: u64,
    /// Maximum number of drawings to return; `None` means all.
    most: Option<usize>,
}

async fn library(
    State(routes): State<Arc<Routes>>,
    Query(ChangesQuery { since, most }): Query<ChangesQuery>,
) -> Response {
    (
        [(CONTENT_TYPE, JSON)],
        escaping::json(&routes.hub.library(since, most.unwrap_or(usize::MAX))).into_owned(),
    )
        .into_response()
}

/// Query of a request for a path, or for a whole drawing.
#[derive(Deserialize)]
struct SceneQuery {
    file: String,
    path: Option<String>,
}

const JSON: &str = "application/json";

async fn scene(State(routes): State<Arc<Routes>>, Query(query): Query<SceneQuery>) -> Response {
    answer_with(&routes, drawing(query, AnswerForm::Scene), JSON).await
}

async fn picture(State(routes): State<Arc<Routes>>, Query(query): Query<SceneQuery>) -> Response {
    answer_with(&routes, drawing(query, AnswerForm::Picture), "image/svg+xml").await
}

fn drawing(SceneQuery { file, path }: SceneQuery, form: AnswerForm) -> Subject {
    Subject::Drawing { file, path, form }
}

/// Maximum size in bytes of a program that a page may send.
const MAX_PROGRAM_BYTES: usize = 64 << 20;

/// Query of a request that sends a program: the program's name, and assumptions about it.
#[derive(Deserialize)]
struct ProgramQuery {
    name: String,
    #[serde(flatten)]
    assumptions: Assumptions,
}

async fn program(
    State(routes): State<Arc<Routes>>,
    Query(ProgramQuery { name, assumptions }): Query<ProgramQuery>,
    text: Bytes,
) -> Response {
    let program = DroppedProgram { name, text: text.into(), assumptions };
    answer_with(&routes, Subject::Program(program), JSON).await
}

async fn answer_with(routes: &Routes, subject: Subject, kind: &'static str) -> Response {
    match routes.hub.ask(subject).await {
        Ok(Some(text)) => ([(CONTENT_TYPE, kind)], text).into_response(),
        Ok(None) => StatusCode::NOT_FOUND.into_response(),
        // The watching thread has ended or is restarting.
        Err(_) => StatusCode::SERVICE_UNAVAILABLE.into_response(),
    }
}

/// Returns a stream of the numbers of changes, beginning with the number of the last change so far.
async fn events(State(routes): State<Arc<Routes>>) -> impl IntoResponse {
    let (revisions, run) = (routes.hub.revisions(), routes.run.clone());
    let open = OpenPageGuard::new(routes.pages.clone());
    let numbers = stream::unfold((revisions, true, open), move |(mut revisions, is_first, open)| {
        let run = run.clone();
        async move {
            if !is_first {
                revisions.changed().await.ok()?;
            }
            let revision = *revisions.borrow_and_update();
            let event = Event::default().data(format!("{run} {revision}"));
            Some((Ok::<_, Infallible>(event), (revisions, false, open)))
        }
    });
    Sse::new(numbers).keep_alive(KeepAlive::default())
}

/// Guard that counts a page as open until it is dropped.
struct OpenPageGuard(watch::Sender<usize>);

impl OpenPageGuard {
    fn new(pages: watch::Sender<usize>) -> Self {
        pages.send_modify(|open| *open += 1);
        Self(pages)
    }
}

impl Drop for OpenPageGuard {
    fn drop(&mut self) {
        self.0.send_modify(|open| *open -= 1);
    }
}
