//! The description of the interface as a JSON schema.

use serde_json::{Value, json};
use utoipa::OpenApi;

use super::{Message, Request};

/// Collects the schemas of both directions, with all types that they name.
#[derive(OpenApi)]
#[openapi(components(schemas(Request, Message)))]
struct Interface;

/// A JSON schema of the lines in both directions: `Request` from programs, `Message` from the console. A request may
/// also have an `id`, a number that its answers repeat.
pub fn schema() -> Value {
    let components = Interface::openapi().components;
    let described = components.map(|it| it.schemas).unwrap_or_default();
    let definitions = serde_json::to_value(described).unwrap_or_default();
    let text = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "sortie: interface for programs",
        "oneOf": [
            {"$ref": "#/components/schemas/Request"},
            {"$ref": "#/components/schemas/Message"},
        ],
        "components": {"schemas": definitions},
    });
    text
}
