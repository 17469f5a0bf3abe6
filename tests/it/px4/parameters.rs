//! Parameters, whose integers PX4 sends by their bytes.

use sortie::commands::{Command, ParameterCommand};
use sortie::ledger::RowState;
use sortie::parameters;

use super::Talk;
use super::stand_in::Unwilling;

#[test]
fn parameters_are_read_and_set_by_the_bytes_of_their_type() {
    let mut talk = Talk::new();
    let set = |value| {
        Command::Parameter(ParameterCommand::Set {
            name: "COM_RC_IN_MODE".to_owned(),
            value,
        })
    };
    talk.order(1, "param", set(4.0));
    assert_eq!(talk.last(1), Some(RowState::Refused));
    assert!(talk.explanation(1).contains("param get COM_RC_IN_MODE"));
    talk.px4.stick_mode = -3;
    talk.session.fetch_parameters(talk.now);
    talk.pass(2);
    let list = talk.session.parameters().list;
    assert!(list.is_complete());
    let value = |name: &str| list.get(name).map(|known| known.value);
    assert_eq!(
        (value("COM_RC_IN_MODE"), value("MPC_XY_P")),
        (Some(-3.0), Some(f64::from(0.95_f32)))
    );
    talk.order(2, "param", set(4.0));
    talk.pass(1);
    assert_eq!(
        talk.last(2),
        Some(RowState::Done),
        "{}",
        talk.explanation(2)
    );
    assert_eq!(talk.explanation(2), "COM_RC_IN_MODE = 4");
    assert_eq!((talk.px4.stick_mode, talk.px4.faults.len()), (4, 0));
    talk.order(3, "param", set(2.5));
    assert_eq!(
        talk.last(3),
        Some(RowState::Refused),
        "it is a whole number"
    );
}

#[test]
fn integers_of_32_bits_keep_every_bit_to_the_file() {
    let mut talk = Talk::new();
    // A denormal float, a large one, and NaNs, if their bytes were read as a float.
    for (entry, value) in (1..).zip([
        -2_147_483_647,
        0x7f12_3456,
        0x7fa0_0001,
        2_143_289_345,
        16_777_217,
        i32::MAX,
        i32::MIN,
    ]) {
        talk.px4.stick_mode = value - value.signum();
        talk.session.fetch_parameters(talk.now);
        talk.pass(2);
        let exact = f64::from(value - value.signum());
        let list = talk.session.parameters().list;
        let known = list.get("COM_RC_IN_MODE").expect("listed");
        assert_eq!(known.value.to_bits(), exact.to_bits(), "read {value}");
        let set = ParameterCommand::Set {
            name: "COM_RC_IN_MODE".to_owned(),
            value: value.into(),
        };
        talk.order(entry, "param", Command::Parameter(set));
        talk.pass(1);
        assert_eq!(talk.explanation(entry), format!("COM_RC_IN_MODE = {value}"));
        assert_eq!(talk.last(entry), Some(RowState::Done));
        assert_eq!(talk.px4.stick_mode, value);
        let list = talk.session.parameters().list;
        let values = || list.iter().map(|(name, known)| (name, known.value));
        let file = parameters::write("", values());
        assert!(
            file.contains(&format!("COM_RC_IN_MODE,{value}\n")),
            "{file}"
        );
        let read = parameters::parse(&file).expect("a good file");
        let read = read.iter().map(|(name, value)| (name.as_str(), *value));
        assert_eq!(parameters::differences(values(), read), []);
    }
    assert!(talk.px4.faults.is_empty(), "{:?}", talk.px4.faults);
}

#[test]
fn a_neighbour_of_a_large_integer_is_another_value() {
    let mut talk = Talk::new();
    talk.session.fetch_parameters(talk.now);
    talk.pass(2);
    // The vehicle keeps its own value.
    talk.px4.unwilling = Some(Unwilling::TakeValues);
    talk.px4.stick_mode = 0x7f12_3456;
    let set = ParameterCommand::Set {
        name: "COM_RC_IN_MODE".to_owned(),
        value: f64::from(0x7f12_3457),
    };
    talk.order(1, "param", Command::Parameter(set));
    talk.pass(3);
    assert_eq!(talk.last(1), Some(RowState::Refused));
    assert!(
        talk.explanation(1).contains("2131899478"),
        "{}",
        talk.explanation(1)
    );
}
