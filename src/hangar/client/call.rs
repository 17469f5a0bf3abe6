//! One request over its own connection.

use std::io;
use std::time::Duration;

use http_body_util::{BodyExt as _, Full, Limited};
use hyper::body::{Bytes, Incoming};
use hyper::client::conn::http1;
use hyper::{Method, Request, Response, StatusCode, header};
use hyper_util::rt::TokioIo;
use tokio::net::TcpStream;
use tokio::time::timeout;

use super::{ANSWER, ClientError, RemoteHangar};
use crate::hangar::service::ServiceProblem;

/// The maximum size of an answer in bytes: a few hundred instances with their last output.
const ANSWER_MAX: usize = 8 * 1024 * 1024;
/// The number of characters shown of an answer that does not come from a hangar.
const SHOWN: usize = 60;

impl RemoteHangar {
    /// Sends a request, and reads the whole answer if it is successful.
    pub(super) async fn exchange(
        &self,
        method: Method,
        path: &str,
        body: Option<Vec<u8>>,
    ) -> Result<Bytes, ClientError> {
        let whole = async {
            let request = self.request(method, path, body)?;
            let response = self.send(request).await?;
            self.bytes(response).await
        };
        let late = |_| self.late(ANSWER);
        timeout(ANSWER, whole).await.map_err(late)?
    }

    /// A request with the common headers.
    pub(super) fn request(
        &self,
        method: Method,
        path: &str,
        body: Option<Vec<u8>>,
    ) -> Result<Request<Full<Bytes>>, ClientError> {
        let mut request = Request::builder()
            .method(method)
            .uri(path)
            .header(header::HOST, self.address.authority())
            .header(header::ACCEPT, "application/json");
        if let Some(token) = &self.token {
            request = request.header(header::AUTHORIZATION, token.authorization());
        }
        if let Some(life) = &self.life {
            request = request.header(header::IF_MATCH, format!("\"{life}\""));
        }
        if body.is_some() {
            request = request.header(header::CONTENT_TYPE, "application/json");
        }
        request
            .body(Full::from(body.unwrap_or_default()))
            .map_err(|error| self.unreachable(io::Error::other(error)))
    }

    /// Sends a request; the returned answer comes from a hangar and is successful.
    pub(super) async fn send(
        &self,
        request: Request<Full<Bytes>>,
    ) -> Result<Response<Incoming>, ClientError> {
        let place = (self.address.host.as_str(), self.address.port);
        let stream = TcpStream::connect(place)
            .await
            .map_err(|error| self.unreachable(error))?;
        // Commands are small and must not wait for one another; without this option, they are only slower.
        let _ = stream.set_nodelay(true);
        let foreign = |error: hyper::Error| self.broken(&error);
        let (mut sender, connection) = http1::handshake(TokioIo::new(stream))
            .await
            .map_err(foreign)?;
        // The task ends with the answer, or with the upgraded connection.
        tokio::spawn(connection.with_upgrades());
        let response = sender.send_request(request).await.map_err(foreign)?;
        let status = response.status();
        if status.is_success() || status == StatusCode::SWITCHING_PROTOCOLS {
            return Ok(response);
        }
        let bytes = self.bytes(response).await?;
        Err(self.refusal(status, &bytes))
    }

    async fn bytes(&self, response: Response<Incoming>) -> Result<Bytes, ClientError> {
        let body = Limited::new(response.into_body(), ANSWER_MAX);
        let all = body.collect().await;
        all.map(http_body_util::Collected::to_bytes)
            .map_err(|error| self.unreachable(io::Error::other(error)))
    }

    fn refusal(&self, status: StatusCode, bytes: &[u8]) -> ClientError {
        let Ok(problem) = serde_json::from_slice::<ServiceProblem>(bytes) else {
            let body = String::from_utf8_lossy(bytes);
            let start: String = body
                .chars()
                .filter(|c| !c.is_control())
                .take(SHOWN)
                .collect();
            return self.not_a_hangar(format!("{status} {start}").trim().to_owned());
        };
        if status == StatusCode::UNAUTHORIZED {
            return ClientError::Unauthorised {
                address: self.address.clone(),
                why: problem.error,
            };
        }
        let status = status.as_u16();
        ClientError::Refused { status, problem }
    }

    pub(super) fn unreachable(&self, source: io::Error) -> ClientError {
        ClientError::Unreachable {
            address: self.address.clone(),
            source,
        }
    }

    pub(super) fn not_a_hangar(&self, why: String) -> ClientError {
        ClientError::NotAHangar {
            address: self.address.clone(),
            why,
        }
    }

    pub(super) fn late(&self, limit: Duration) -> ClientError {
        ClientError::Late {
            address: self.address.clone(),
            seconds: limit.as_secs(),
        }
    }

    /// The error for an answer that is not HTTP, or for a connection that ends midway.
    fn broken(&self, error: &hyper::Error) -> ClientError {
        if error.is_parse() {
            return self.not_a_hangar(error.to_string());
        }
        self.unreachable(io::Error::other(error.to_string()))
    }
}
