//! Admits only requests from pages that this server delivered.

use axum::http::header::{self, HeaderMap, HeaderValue};
use axum::http::request::Parts;
use axum::http::{Method, StatusCode};

use super::endpoint::Endpoint;

/// Prefix of routes that return data of drawings.
pub(super) const DATA: &str = "/api/";

/// Decides whether a request is answered.
///
/// # Errors
/// Status of a refused request.
pub(super) fn admit(endpoint: &Endpoint, request: &Parts) -> Result<(), StatusCode> {
    if request.method != Method::GET {
        return Err(StatusCode::METHOD_NOT_ALLOWED);
    }
    let is_called_rightly = match single(&request.headers, header::HOST) {
        SingleHeader::One(host) => endpoint.answers_to(host),
        SingleHeader::None | SingleHeader::Other => false,
    };
    // The request line may name another server than the header.
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
        Some(token) if request.uri.path().starts_with(DATA) && !has_token(&request.headers, token) => {
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

/// Value of a header that may occur only once.
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

/// Headers of every response: nothing is loaded from elsewhere, nothing is cached, no other page may embed it.
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
