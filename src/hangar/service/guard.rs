//! Access control.
//!
//! On loopback, other users of the host can connect, and so can web pages in a user's browser. A connection is
//! therefore accepted only with the token, or if the program at its other end belongs to the same user. A request from
//! a foreign web page is refused even then, since it comes from the user's own browser.

use std::net::{IpAddr, SocketAddr};
use std::sync::{Arc, OnceLock};

use axum::extract::{Request, State};
use axum::http::uri::Authority;
use axum::http::{HeaderMap, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse as _, Response};

use super::{Owner, ServiceProblem, ServiceState};
use crate::hangar::process::own_user;

/// The two ends of a connection.
#[derive(Debug)]
pub(super) struct ConnectionEnds {
    pub peer: SocketAddr,
    pub local: SocketAddr,
    owner: OnceLock<Option<u32>>,
}

impl ConnectionEnds {
    pub fn new(peer: SocketAddr, local: SocketAddr) -> Self {
        Self {
            peer,
            local,
            owner: OnceLock::new(),
        }
    }

    /// Whether the program at the other end belongs to this program's user, or to root.
    pub fn is_own(&self, owner: Owner) -> bool {
        let on_loopback = |address: SocketAddr| address.ip().to_canonical().is_loopback();
        let uid = || *self.owner.get_or_init(|| owner(self.peer, self.local));
        on_loopback(self.peer)
            && on_loopback(self.local)
            && uid().is_some_and(|uid| uid == 0 || uid == own_user())
    }
}

/// Passes a request on, or refuses it with the reason.
pub(super) async fn check(
    State(state): State<Arc<ServiceState>>,
    request: Request,
    next: Next,
) -> Response {
    match state.admit(&request) {
        Ok(()) => next.run(request).await,
        Err(problem) => problem.into_response(),
    }
}

impl ServiceState {
    fn admit(&self, request: &Request) -> Result<(), ServiceProblem> {
        let headers = request.headers();
        if headers.get_all(header::HOST).iter().count() > 1 {
            let error = "the request names its host more than once";
            return Err(ServiceProblem::new(StatusCode::BAD_REQUEST, error));
        }
        // An absolute address in the request line takes precedence over the header (RFC 9112, 3.2.2).
        let whole = request.uri().authority().map(Authority::as_str);
        let host = whole.or_else(|| text(headers, &header::HOST));
        // On other interfaces the token is required, which a foreign page does not have.
        if self.on_loopback && !host.is_some_and(is_this_host) {
            let host = host.unwrap_or("nothing");
            let error = format!("the request calls this host `{host}`, which is not its name");
            return Err(ServiceProblem::new(StatusCode::FORBIDDEN, error)
                .hint("use http://127.0.0.1:PORT or http://localhost:PORT"));
        }
        if is_foreign_page(headers, host) {
            let error = "pages of other sites may not send requests here";
            return Err(ServiceProblem::new(StatusCode::FORBIDDEN, error));
        }
        self.authorise(request)?;
        let life = text(headers, &header::IF_MATCH).map(|life| life.trim_matches('"'));
        if life.is_some_and(|life| life != self.life) {
            let error = "the hangar was restarted: its instances have changed";
            return Err(ServiceProblem::new(StatusCode::PRECONDITION_FAILED, error));
        }
        Ok(())
    }

    fn authorise(&self, request: &Request) -> Result<(), ServiceProblem> {
        let refuse = |error: &str| {
            ServiceProblem::new(StatusCode::UNAUTHORIZED, error).hint(
                "send the header `Authorization: Bearer TOKEN` with the token of the hangar's token file",
            )
        };
        if let Some(given) = request.headers().get(header::AUTHORIZATION) {
            let given = given.to_str().unwrap_or_default();
            let (scheme, given) = given.split_once(' ').unwrap_or((given, ""));
            return if !scheme.eq_ignore_ascii_case("bearer") {
                Err(refuse("the header Authorization contains no bearer token"))
            } else if self.setup.token.matches(given.trim()) {
                Ok(())
            } else {
                Err(refuse("the token is not valid for this hangar"))
            };
        }
        let line = request.extensions().get::<Arc<ConnectionEnds>>();
        let is_own = || line.is_some_and(|line| line.is_own(self.setup.owner));
        if self.on_loopback && !self.setup.require_token && is_own() {
            return Ok(());
        }
        Err(refuse("a token is required here"))
    }
}

fn text<'a>(headers: &'a HeaderMap, name: &header::HeaderName) -> Option<&'a str> {
    headers.get(name)?.to_str().ok()
}

/// Whether a `HOST` or `HOST:PORT` names this host. The port may differ, as with `ssh -L`.
fn is_this_host(host: &str) -> bool {
    let name = match host.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|byte| byte.is_ascii_digit()) => name,
        _ => host,
    };
    let bare = name.trim_start_matches('[').trim_end_matches(']');
    let by_address = bare.parse::<IpAddr>().is_ok_and(|ip| ip.is_loopback());
    by_address || name.eq_ignore_ascii_case("localhost")
}

/// Whether a browser marks a request as sent by a foreign page. The service has no pages, so every page is foreign; a
/// request for a typed address does not come from a page.
fn is_foreign_page(headers: &HeaderMap, host: Option<&str>) -> bool {
    let ours = format!("http://{}", host.unwrap_or_default());
    let origin = text(headers, &header::ORIGIN);
    let has_origin = headers.contains_key(header::ORIGIN) && origin != Some(ours.as_str());
    let site = headers.get("sec-fetch-site");
    let from_site = site.is_some_and(|site| site != "none" && site != "same-origin");
    has_origin || from_site
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_host_is_known_by_its_loopback_names() {
        for host in [
            "localhost",
            "LocalHost:5700",
            "127.0.0.1",
            "127.0.0.1:5700",
            "127.1.2.3:1",
            "[::1]:5700",
            "[::1]",
        ] {
            assert!(is_this_host(host), "{host}");
        }
        for host in [
            "",
            "evil.example",
            "evil.example:5700",
            "127.0.0.1.evil.example",
            "localhost.evil.example:5700",
            "192.168.1.2:5700",
            "0.0.0.0:5700",
        ] {
            assert!(!is_this_host(host), "{host}");
        }
    }
}
