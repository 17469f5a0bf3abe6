use proptest::prelude::*;

use super::*;

const FILE: &str = include_str!("../../../fuzz/seeds/documentation/events.json");

fn documents() -> EventDocuments {
    let read = EventDocuments::read(FILE).expect("a good file");
    assert_eq!(read.faults.len(), 1, "{:?}", read.faults);
    read.documents
}

fn text(id: u32, arguments: &[u8]) -> Option<String> {
    documents().text(id, arguments)
}

#[test]
fn an_event_is_found_by_component_and_number() {
    assert_eq!(documents().len(), 5);
    assert_eq!(
        text((1 << 24) + 100, &[]).as_deref(),
        Some("Geofence violation")
    );
    assert_eq!(text(100, &[]), None);
}

#[test]
fn arguments_have_names_decimals_and_units() {
    let mut bytes = vec![2, 0b101];
    bytes.extend((-12i16).to_le_bytes());
    bytes.extend(1.26f32.to_le_bytes());
    bytes.extend([0; 8]);
    assert_eq!(
        text((1 << 24) + 101, &bytes).as_deref(),
        Some("Battery 2nd, faults low/hot, -12 m at 1.3 m/s, {9} {x} {1")
    );
    assert_eq!(text((1 << 24) + 101, &bytes[..7]), None, "it is cut off");
    let unknown = [9, 0b1000, 0, 0, 0, 0, 0, 0];
    let said = text((1 << 24) + 101, &unknown).expect("it is documented");
    assert!(said.starts_with("Battery 9, faults 8, 0 m"), "{said}");
}

#[test]
fn tags_are_read_and_other_readers_parts_left_out() {
    assert_eq!(
        text((1 << 24) + 102, &[]).as_deref(),
        Some("Set COM_ARM_WO_GPS, see the guide for developers <b and {1}")
    );
}

#[test]
fn enums_of_other_components_and_wide_numbers_are_known() {
    let mut bytes = vec![1];
    bytes.extend(u64::MAX.to_le_bytes());
    assert_eq!(
        text(2 << 24 | 1, &bytes).as_deref(),
        Some("1st 18446744073709551615")
    );
}

#[test]
fn faults_name_what_is_wrong() {
    for (file, word) in [
        ("", "JSON"),
        (r#"{"version": 1}"#, "version 1"),
        (r#"{"version": 2}"#, "no event"),
    ] {
        let fault = EventDocuments::read(file).expect_err("a bad file");
        assert!(fault.to_string().contains(word), "{fault}");
    }
}

proptest! {
    #[test]
    fn no_text_makes_the_reader_stumble(
        message in "[a{}<>/\\\\:.0-9mé\" ]{0,60}",
        arguments in proptest::collection::vec(any::<u8>(), 0..12),
    ) {
        let event = serde_json::json!({"version": 2, "components": {"1": {"namespace": "a",
            "event_groups": {"b": {"events": {"7": {"name": "c", "message": message,
            "arguments": [{"name": "d", "type": "float"}]}}}}}}});
        let read = EventDocuments::read(&event.to_string());
        if let Ok(read) = read {
            drop(read.documents.text((1 << 24) + 7, &arguments));
        }
    }
}
