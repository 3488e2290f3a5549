//! Who is answered: pages that this server gave out, and nobody else.

use axum::http::header::{self, HeaderMap, HeaderValue};
use axum::http::request::Parts;
use axum::http::{Method, StatusCode};

use super::door::Door;

/// Below this lies what is in drawings.
pub(super) const DATA: &str = "/api/";

/// Whether a request is answered.
///
/// # Errors
/// Why not.
pub(super) fn admit(door: &Door, request: &Parts) -> Result<(), StatusCode> {
    if request.method != Method::GET {
        return Err(StatusCode::METHOD_NOT_ALLOWED);
    }
    let is_called_rightly = match single(&request.headers, header::HOST) {
        Single::One(host) => door.answers_to(host),
        Single::None | Single::Other => false,
    };
    // A request line may name another server than the header does.
    let is_meant = request.uri.authority().is_none_or(|authority| door.answers_to(authority.as_str()));
    if !is_called_rightly || !is_meant {
        return Err(StatusCode::MISDIRECTED_REQUEST);
    }
    let is_own = match single(&request.headers, header::ORIGIN) {
        Single::None => true,
        Single::One(origin) => origin.strip_prefix("http://").is_some_and(|origin| door.answers_to(origin)),
        Single::Other => false,
    };
    if !is_own {
        return Err(StatusCode::FORBIDDEN);
    }
    match door.token() {
        Some(token) if request.uri.path().starts_with(DATA) && !shows(&request.headers, token) => {
            Err(StatusCode::UNAUTHORIZED)
        }
        _ => Ok(()),
    }
}

/// Whether a request shows the token. Hashes are compared, which takes as long wherever they differ.
fn shows(headers: &HeaderMap, token: &str) -> bool {
    let Single::One(given) = single(headers, header::AUTHORIZATION) else { return false };
    let Some(given) = given.strip_prefix("Bearer ") else { return false };
    blake3::hash(given.as_bytes()) == blake3::hash(token.as_bytes())
}

/// What stands in a header that may be there once.
enum Single<'a> {
    None,
    One(&'a str),
    /// There are several, or it is no text.
    Other,
}

fn single(headers: &HeaderMap, name: header::HeaderName) -> Single<'_> {
    let mut values = headers.get_all(name).iter().map(HeaderValue::to_str);
    match (values.next(), values.next()) {
        (None, _) => Single::None,
        (Some(Ok(value)), None) => Single::One(value),
        _ => Single::Other,
    }
}

/// What browsers are told with every answer: nothing is loaded from elsewhere, nothing is kept, no other page may use it.
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
