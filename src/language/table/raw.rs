//! Verbs that send commands and messages as typed.

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{MavMessage, SETUP_SIGNING_DATA};

use super::{Built, command, confirmed};
use crate::commands::{Command, RawCommand, RawMessage};
use crate::inspector::{Definitions, write};
use crate::language::argument::{Argument, Arguments, Kind, Problem, Unit};
use crate::language::verb::{Form, Scope, VerbRow};
use crate::text;
use crate::wire::is_secret;

/// Any value that fits a float on the wire.
pub(super) const ANY: Kind = Kind::Number(Unit::None, -(f32::MAX as f64), f32::MAX as f64);
const ANY_I32: Kind = Kind::Whole(Unit::None, i32::MIN as f64, i32::MAX as f64);

pub(super) const LONG: VerbRow = VerbRow {
    verb: confirmed("long"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["long NAV_TAKEOFF 0 0 0 0 0 0 20", "long 400 1"],
    forms: &[Form::new(
        &[
            Argument::value("command", Kind::MavCommand, "argument-name-or-number"),
            Argument::value("p1", ANY, "").optional(),
            Argument::value("p2", ANY, "").optional(),
            Argument::value("p3", ANY, "").optional(),
            Argument::value("p4", ANY, "").optional(),
            Argument::value("p5", ANY, "").optional(),
            Argument::value("p6", ANY, "").optional(),
            Argument::value("p7", ANY, "").optional(),
        ],
        |given| {
            command(Command::Raw(RawCommand::Long {
                command: given.required("command")? as u16,
                params: ["p1", "p2", "p3", "p4", "p5", "p6", "p7"]
                    .map(|name| given.number(name).unwrap_or(0.0) as f32),
            }))
        },
    )],
};

pub(super) const INT: VerbRow = VerbRow {
    verb: confirmed("int"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &["int DO_REPOSITION 6 -1 1 0 0 504501000 305234000 40"],
    forms: &[Form::new(
        &[
            Argument::value("command", Kind::MavCommand, "argument-name-or-number"),
            Argument::value(
                "frame",
                Kind::Whole(Unit::None, 0.0, 255.0),
                "argument-mav-frame",
            ),
            Argument::value("p1", ANY, ""),
            Argument::value("p2", ANY, ""),
            Argument::value("p3", ANY, ""),
            Argument::value("p4", ANY, ""),
            Argument::value("x", ANY_I32, ""),
            Argument::value("y", ANY_I32, ""),
            Argument::value("z", ANY, ""),
        ],
        int,
    )],
};

fn int(given: &Arguments) -> Built {
    let params: Result<Vec<f32>, Problem> = ["p1", "p2", "p3", "p4"]
        .into_iter()
        .map(|name| Ok(given.required(name)? as f32))
        .collect();
    command(Command::Raw(RawCommand::Int {
        command: given.required("command")? as u16,
        frame: given.required("frame")? as u8,
        params: params?
            .try_into()
            .map_err(|_| Problem::new("p4", text!("grammar-four-parameters")))?,
        x: given.required("x")? as i32,
        y: given.required("y")? as i32,
        z: given.required("z")? as f32,
    }))
}

pub(super) const SEND: VerbRow = VerbRow {
    verb: confirmed("send"),
    scope: Scope::Everywhere,
    aliases: &[],
    examples: &[
        "3 send HEARTBEAT type=GCS autopilot=INVALID",
        "send PARAM_REQUEST_READ param_index=-1 param_id=WPNAV_SPEED",
        "send SET_ATTITUDE_TARGET q=[1,0,0,0] thrust=0.5 type_mask=BODY_ROLL_RATE_IGNORE|BODY_PITCH_RATE_IGNORE",
    ],
    forms: &[Form::new(
        &[
            Argument::value("message", Kind::Message, "argument-name-or-id"),
            Argument::value("fields", Kind::Fields, "argument-message-fields").optional(),
        ],
        send,
    )],
};

fn send(given: &Arguments) -> Built {
    let id = given.required("message")? as u32;
    let refused = |message| Problem::new("message", message);
    let is_known = MavMessage::all_messages()
        .iter()
        .any(|(_, known)| *known == id);
    let definition = Definitions::get().message(id).filter(|_| is_known);
    let Some(definition) = definition else {
        return Err(refused(text!("grammar-no-message", word = id.to_string())));
    };
    let name = definition.name;
    if is_secret(id) {
        let fault = refused(text!("grammar-secret-message", message = name));
        return Err(if id == SETUP_SIGNING_DATA::ID {
            fault.with_help(text!("grammar-secret-message-signing"))
        } else {
            fault
        });
    }
    let fields = given.word("fields").unwrap_or_default().to_owned();
    let payload = write(definition, &fields).map_err(|fault| Problem::within("fields", fault))?;
    command(Command::Raw(RawCommand::Message(RawMessage {
        id,
        name,
        fields,
        payload,
    })))
}
