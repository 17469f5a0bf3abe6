//! The JSON schema (draft 2020-12) of mission files, for editors, from their description.
//!
//! Rules that a schema cannot express (names that refer to something, sums, one value above another) are checked by the
//! reader only.

use serde_json::{Map, Value, json};

use super::description::{FileKey, FileShape, FileTableDescription, KindDescription, Presence};

/// The schema of a file, as JSON text.
pub(in crate::mission) fn schema(file: &FileTableDescription) -> String {
    let mut root = keys_schema(&file.keys, None);
    root.insert(
        "$schema".to_owned(),
        json!("https://json-schema.org/draft/2020-12/schema"),
    );
    root.insert("title".to_owned(), json!("A sortie mission"));
    format!("{:#}", Value::Object(root))
}

impl FileTableDescription {
    fn schema(&self) -> Value {
        if self.kinds.is_empty() {
            return Value::Object(keys_schema(&self.keys, None));
        }
        let kinds: Vec<Value> = self
            .kinds
            .iter()
            .map(|kind| self.kind_schema(kind))
            .collect();
        json!({ "oneOf": kinds })
    }

    fn kind_schema(&self, kind: &KindDescription) -> Value {
        let keys: Vec<FileKey> = self.keys.iter().chain(&kind.own.keys).cloned().collect();
        let name = self.by_kind_key.then_some(kind.name);
        Value::Object(keys_schema(&keys, name))
    }
}

/// A table with exactly these keys, of the given kind if there are kinds.
fn keys_schema(keys: &[FileKey], kind: Option<&str>) -> Map<String, Value> {
    let (mut properties, mut required) = (Map::new(), Vec::new());
    for key in keys {
        let mut value = key.shape.schema();
        if let Value::Object(rules) = &mut value
            && !key.about.is_empty()
        {
            rules.insert("description".to_owned(), json!(key.about));
        }
        properties.insert(key.name.clone(), value);
        if key.presence == Presence::Needed {
            required.push(key.name.as_str());
        }
    }
    if let Some(kind) = kind {
        properties.insert("kind".to_owned(), json!({ "const": kind }));
        required.push("kind");
    }
    let mut table = Map::new();
    table.insert("type".to_owned(), json!("object"));
    table.insert("properties".to_owned(), Value::Object(properties));
    table.insert("required".to_owned(), json!(required));
    table.insert("additionalProperties".to_owned(), json!(false));
    table
}

impl FileShape {
    fn schema(&self) -> Value {
        match self {
            Self::Number(low, high, _) => {
                json!({ "type": "number", "minimum": low, "maximum": high })
            }
            Self::Whole(low, high, _) => {
                json!({ "type": "integer", "minimum": low, "maximum": high })
            }
            Self::Flag => json!({ "type": "boolean" }),
            Self::Text(_, None) => json!({ "type": "string" }),
            Self::Text(_, Some(most)) => json!({ "type": "string", "maxLength": most }),
            Self::Numbers {
                count, low, high, ..
            } => json!({
                "type": "array", "minItems": count, "maxItems": count,
                "items": { "type": "number", "minimum": low, "maximum": high },
            }),
            Self::Words(words) | Self::Named(_, words) => json!({ "enum": words }),
            Self::NumberOrWord(_) => json!({ "type": ["integer", "string"] }),
            Self::List(of, least, most) => list_schema(of, *least, *most),
            Self::Map(_, of) => {
                json!({ "type": "object", "additionalProperties": of.schema() })
            }
            Self::Table(table) => table.schema(),
        }
    }
}

fn list_schema(of: &FileShape, least: usize, most: usize) -> Value {
    let mut list = json!({ "type": "array", "items": of.schema() });
    if let Value::Object(rules) = &mut list {
        if least > 0 {
            rules.insert("minItems".to_owned(), json!(least));
        }
        if most < usize::MAX {
            rules.insert("maxItems".to_owned(), json!(most));
        }
    }
    list
}
