//! The tools for language models, and the console requests that they make.

use serde::Deserialize;
use serde_json::{Value, json};
use strum::VariantArray as _;

use super::rpc::Params;
use crate::api::{Request, Subject};
use crate::vehicle_id::{HIGHEST_VEHICLE, VehicleId};

/// The tool that carries out lines of the command language.
const SAY: &str = "say";

/// Why a call makes no request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CallFault {
    /// The call names no tool of this server, or is malformed.
    Call(String),
    /// The arguments do not fit the tool; the model can correct them.
    Arguments(String),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct NoArguments {}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OneVehicle {
    vehicle: VehicleId,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SaidLine {
    line: String,
    #[serde(default)]
    confirm: bool,
}

/// The descriptions of all tools, as the protocol lists them.
pub fn list(allows_commands: bool) -> Vec<Value> {
    let reading = Subject::VARIANTS.iter().map(|what| reading_tool(*what));
    let saying = allows_commands.then(say_tool);
    reading.chain(saying).collect()
}

fn reading_tool(what: Subject) -> Value {
    let schema = if is_of_one_vehicle(what) {
        let vehicle = json!({
            "type": "integer",
            "minimum": 1,
            "maximum": HIGHEST_VEHICLE,
            "description": "The number of the vehicle.",
        });
        json!({
            "type": "object",
            "properties": {"vehicle": vehicle},
            "required": ["vehicle"],
            "additionalProperties": false,
        })
    } else {
        json!({"type": "object", "additionalProperties": false})
    };
    json!({
        "name": <&str>::from(what),
        "description": description(what),
        "inputSchema": schema,
        "annotations": {"readOnlyHint": true},
    })
}

fn say_tool() -> Value {
    let schema = json!({
        "type": "object",
        "properties": {
            "line": {
                "type": "string",
                "description": "The line: targets, verb, arguments. The targets have to be named.",
            },
            "confirm": {
                "type": "boolean",
                "description": "Carry out a line that needs a confirmation, such as `all kill`. Ask the user first.",
            },
        },
        "required": ["line"],
        "additionalProperties": false,
    });
    json!({
        "name": SAY,
        "description": "Carry out a line of the command language, such as `all mode guided`, `all arm`, \
                        `1-4 takeoff 20` or `1,3 rtl`. The result comes when the command has ended for every \
                        vehicle, with a row for each.",
        "inputSchema": schema,
        "annotations": {"readOnlyHint": false, "destructiveHint": true},
    })
}

fn description(what: Subject) -> &'static str {
    match what {
        Subject::Vehicles => {
            "Read the latest telemetry of every vehicle: mode, position, speed, battery, link, and the reasons not to \
             arm."
        }
        Subject::Notices => "Read the notices that the console lists, with severity and vehicle.",
        Subject::Ledger => {
            "Read the commands that the console lists, with their outcome for each vehicle."
        }
        Subject::Mission => {
            "Read the mission that is flown: time, score, objectives, readings, contacts, alerts and places; null \
             outside of missions."
        }
        Subject::Links => "Read the links to the vehicles: traffic, losses and errors.",
        Subject::Traffic => {
            "Read other aircraft (ADS-B), with the time and distance of their closest approach to vehicles in the air."
        }
        Subject::Parameters => {
            "Read the parameters of a vehicle, as far as the console has loaded them."
        }
        Subject::Plan => "Read the plan on board a vehicle, as far as the console has loaded it.",
        Subject::Records => "List the records of flights, newest first.",
    }
}

fn is_of_one_vehicle(what: Subject) -> bool {
    match what {
        Subject::Parameters | Subject::Plan => true,
        Subject::Vehicles
        | Subject::Notices
        | Subject::Ledger
        | Subject::Mission
        | Subject::Links
        | Subject::Traffic
        | Subject::Records => false,
    }
}

/// The request to the console for the parameters of `tools/call`.
///
/// # Errors
/// The tool does not exist, or the arguments do not fit it.
pub fn request(params: &mut Params, allows_commands: bool) -> Result<Request, CallFault> {
    let arguments = match params.remove("arguments") {
        None => Value::Object(Params::new()),
        Some(arguments @ Value::Object(_)) => arguments,
        Some(_) => return Err(CallFault::Call("`arguments` must be an object".to_owned())),
    };
    let Some(name) = params.get("name").and_then(Value::as_str) else {
        return Err(CallFault::Call("`name` must be a string".to_owned()));
    };
    match (name, name.parse::<Subject>()) {
        (SAY, _) if !allows_commands => Err(CallFault::Call(
            "commands are not allowed: start `sortie mcp` with --allow-commands".to_owned(),
        )),
        (SAY, _) => {
            let SaidLine { line, confirm } = read(arguments)?;
            Ok(Request::Say { line, confirm })
        }
        (_, Ok(what)) if is_of_one_vehicle(what) => {
            let OneVehicle { vehicle } = read(arguments)?;
            let vehicle = Some(vehicle);
            Ok(Request::Get { what, vehicle })
        }
        (_, Ok(what)) => {
            let NoArguments {} = read(arguments)?;
            let vehicle = None;
            Ok(Request::Get { what, vehicle })
        }
        (_, Err(_)) => Err(CallFault::Call(format!("unknown tool: {name}"))),
    }
}

fn read<T: for<'a> Deserialize<'a>>(arguments: Value) -> Result<T, CallFault> {
    serde_json::from_value(arguments)
        .map_err(|fault| CallFault::Arguments(format!("invalid arguments: {fault}")))
}
