//! The description of the service in `OpenAPI`.

use utoipa::OpenApi as _;
use utoipa::openapi::OpenApi;
use utoipa::openapi::security::{Http, HttpAuthScheme, SecurityRequirement, SecurityScheme};

use super::{about, events, paper, tunnel, vehicles};

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
        about::openapi,
        paper::start,
        paper::stop,
        paper::ready,
        paper::list,
    )
)]
struct Description;

/// The document.
pub(super) fn document() -> OpenApi {
    let mut document = Description::openapi();
    env!("SORTIE_VERSION").clone_into(&mut document.info.version);
    let scheme = SecurityScheme::Http(Http::new(HttpAuthScheme::Bearer));
    let components = document.components.get_or_insert_default();
    components.add_security_scheme(SCHEME, scheme);
    // On loopback the same user's programs need none.
    document.security = Some(vec![
        SecurityRequirement::new(SCHEME, Vec::<String>::new()),
        SecurityRequirement::default(),
    ]);
    document
}
