//! The description of the service in `OpenAPI`.

use std::borrow::Cow;

use axum::Json;
use strum::VariantNames;
use utoipa::openapi::schema::{ObjectBuilder, Schema, Type};
use utoipa::openapi::security::{Http, HttpAuthScheme, SecurityRequirement, SecurityScheme};
use utoipa::openapi::{OpenApi, RefOr};
use utoipa::{OpenApi as _, PartialSchema, ToSchema};

use super::{about, events, paper, tunnel, vehicles};
use crate::config::Restart;
use crate::sitl::{SitlKind, SitlStage};

const SCHEME: &str = "token";

#[derive(utoipa::OpenApi)]
#[openapi(
    info(
        title = "sortie hangar",
        description = "Starts, watches and ends ArduPilot SITL processes on its host."
    ),
    paths(
        vehicles::launch,
        vehicles::list,
        vehicles::one,
        vehicles::remove,
        vehicles::restart,
        vehicles::ready,
        vehicles::output,
        tunnel::open,
        events::follow,
        about::status,
        openapi,
        paper::start,
        paper::stop,
        paper::ready,
        paper::list,
    )
)]
struct Description;

#[utoipa::path(get, path = "/openapi.json", responses(
    (status = 200, description = "The description of the service in OpenAPI 3.1", body = serde_json::Value),
))]
pub(super) async fn openapi() -> Json<OpenApi> {
    Json(document())
}

pub(super) fn document() -> OpenApi {
    let mut document = Description::openapi();
    env!("SORTIE_VERSION").clone_into(&mut document.info.version);
    let scheme = SecurityScheme::Http(Http::new(HttpAuthScheme::Bearer));
    let components = document.components.get_or_insert_default();
    components.add_security_scheme(SCHEME, scheme);
    // On loopback, programs of the same user need no token.
    document.security = Some(vec![
        SecurityRequirement::new(SCHEME, Vec::<String>::new()),
        SecurityRequirement::default(),
    ]);
    document
}

// Pure modules do not depend on the service, so the schemas of their types are built here.

impl ToSchema for SitlKind {
    fn name() -> Cow<'static, str> {
        "Kind".into()
    }
}
impl PartialSchema for SitlKind {
    fn schema() -> RefOr<Schema> {
        words::<Self>("A vehicle that `ArduPilot` is built for.")
    }
}

impl ToSchema for SitlStage {
    fn name() -> Cow<'static, str> {
        "Stage".into()
    }
}
impl PartialSchema for SitlStage {
    fn schema() -> RefOr<Schema> {
        words::<Self>("The stage of an instance.")
    }
}

impl ToSchema for Restart {}
impl PartialSchema for Restart {
    fn schema() -> RefOr<Schema> {
        words::<Self>("The restart policy for an instance that has ended by itself.")
    }
}

/// The schema of an enum that is a name in JSON.
fn words<T: VariantNames>(description: &str) -> RefOr<Schema> {
    ObjectBuilder::new()
        .schema_type(Type::String)
        .description(Some(description))
        .enum_values(Some(T::VARIANTS.iter().copied()))
        .into()
}
