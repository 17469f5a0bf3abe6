//! `PARAM_VALUE`: values of parameters, requested or not.

use std::str;

use mavlink::dialects::ardupilotmega::PARAM_VALUE_DATA;

use crate::parameters::{HeardParameter, ParameterList};

/// `PARAM_VALUE.param_index` of a value that was sent on its own, not as part of the list.
const NO_INDEX: u16 = u16::MAX;

pub(super) fn apply(parameters: &mut ParameterList, data: &PARAM_VALUE_DATA) {
    let bytes: &[u8; 16] = &data.param_id;
    let bytes = bytes.split(|&byte| byte == 0).next().unwrap_or_default();
    // Names are ASCII; other bytes are noise, or not a name.
    let Ok(name) = str::from_utf8(bytes) else {
        return;
    };
    if name.is_empty() || !name.bytes().all(|byte| byte.is_ascii_graphic()) {
        return;
    }
    parameters.note(&HeardParameter {
        name,
        value: data.param_value,
        kind: data.param_type.into(),
        index: (data.param_index != NO_INDEX).then_some(data.param_index),
        count: data.param_count,
    });
}
