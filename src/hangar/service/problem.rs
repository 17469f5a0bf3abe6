//! The answer to a failed request.

use axum::Json;
use axum::http::{Method, StatusCode, Uri, header};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::hangar::HangarRefusal;

/// Why a request failed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[schema(as = Problem)]
pub struct ServiceProblem {
    /// The status of the HTTP answer.
    #[serde(skip)]
    pub(super) status: StatusCode,
    /// The fault and its place.
    pub error: String,
    /// Advice, if there is any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
}

impl ServiceProblem {
    pub(in crate::hangar) fn new(status: StatusCode, error: impl Into<String>) -> Self {
        Self {
            status,
            error: error.into(),
            hint: None,
        }
    }

    pub(super) fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}

impl IntoResponse for ServiceProblem {
    fn into_response(self) -> Response {
        let status = self.status;
        let mut response = (status, Json(self)).into_response();
        let headers = response.headers_mut();
        if status == StatusCode::UNAUTHORIZED {
            let scheme = header::HeaderValue::from_static("Bearer realm=\"sortie hangar\"");
            headers.insert(header::WWW_AUTHENTICATE, scheme);
        }
        if status == StatusCode::SERVICE_UNAVAILABLE {
            headers.insert(header::RETRY_AFTER, header::HeaderValue::from_static("5"));
        }
        response
    }
}

impl From<HangarRefusal> for ServiceProblem {
    fn from(refusal: HangarRefusal) -> Self {
        let status = match &refusal {
            HangarRefusal::Unknown(_) => StatusCode::NOT_FOUND,
            HangarRefusal::Taken(_) | HangarRefusal::Attached(_) => StatusCode::CONFLICT,
            HangarRefusal::Invalid(_) => StatusCode::BAD_REQUEST,
            HangarRefusal::Full(_) | HangarRefusal::NoProgram(_) | HangarRefusal::Closing => {
                StatusCode::SERVICE_UNAVAILABLE
            }
            HangarRefusal::Host { .. } | HangarRefusal::Far { .. } => {
                StatusCode::INTERNAL_SERVER_ERROR
            }
        };
        let hint = match &refusal {
            HangarRefusal::Unknown(_) => Some("GET /vehicles lists the instances"),
            HangarRefusal::Taken(_) => Some("leave `id` out for the lowest free number"),
            HangarRefusal::Attached(_) => Some("`attached` in GET /vehicles shows which are taken"),
            HangarRefusal::Full(_) => {
                Some("DELETE /vehicles/{id} ends one; GET /status shows the limits")
            }
            HangarRefusal::NoProgram(_) => Some("GET /status lists the programs"),
            HangarRefusal::Invalid(_)
            | HangarRefusal::Host { .. }
            | HangarRefusal::Closing
            | HangarRefusal::Far { .. } => None,
        };
        Self {
            hint: hint.map(str::to_owned),
            ..Self::new(status, refusal.to_string())
        }
    }
}

/// Answers a request for an unknown path.
pub(super) async fn no_such_path(uri: Uri) -> ServiceProblem {
    let error = format!("unknown path {}", uri.path());
    ServiceProblem::new(StatusCode::NOT_FOUND, error).hint("GET /openapi.json describes all paths")
}

/// Answers a method that a path does not support.
pub(super) async fn no_such_method(method: Method, uri: Uri) -> ServiceProblem {
    let error = format!("{method} is not supported by {}", uri.path());
    ServiceProblem::new(StatusCode::METHOD_NOT_ALLOWED, error)
        .hint("the header Allow lists the supported methods; GET /openapi.json describes them")
}

/// Answers HEAD where GET acts: HEAD must have no effect.
pub(super) async fn not_by_head(uri: Uri) -> impl IntoResponse {
    let problem = no_such_method(Method::HEAD, uri).await;
    ([(header::ALLOW, "GET")], problem)
}
