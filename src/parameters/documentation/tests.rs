use proptest::prelude::*;

use super::*;

const XML: &str = r#"<?xml version="1.0" encoding="utf-8"?>
<paramfile>
  <vehicles>
    <parameters name="ArduCopter">
      <param humanName="RTL Altitude" name="ArduCopter:RTL_ALT" documentation="Height above&#10;home &lt;before&gt; the return." user="Standard">
        <field name="Units">cm</field>
        <field name="UnitText">centimeters</field>
        <field name="Range">30 300000</field>
        <field name="Increment">1</field>
      </param>
      <param humanName="Throttle failsafe" name="ArduCopter:FS_THR_ENABLE" documentation="">
        <values>
          <value code="1">Enabled always RTL</value>
          <value code="0">Disabled &amp; ignored</value>
        </values>
      </param>
    </parameters>
  </vehicles>
  <libraries>
    <parameters name="LOG_">
      <param humanName="Log mask" name="LOG_BITMASK" documentation="What is logged">
        <field name="Bitmask">0:Fast attitude,1:Medium attitude, 3:System</field>
        <field name="RebootRequired">True</field>
      </param>
      <param humanName="Bare" name="BARE" documentation=""/>
    </parameters>
  </libraries>
</paramfile>
"#;

const JSON: &str = r#"{
  "": {"AEROM_ANG": {"Description": "a", "DisplayName": "Angle", "Units": "deg"}},
  "Copter": {
    "RTL_ALT": {"Description": "Height above home <before> the return.", "DisplayName": "RTL Altitude",
      "Increment": "1", "Range": {"high": "300000", "low": "30"}, "Units": "cm", "User": "Standard"},
    "FS_THR_ENABLE": {"Description": "", "DisplayName": "Throttle failsafe",
      "Values": {"0": "Disabled & ignored", "1": "Enabled always RTL"}}
  },
  "LOG_": {"LOG_BITMASK": {"Description": "What is logged", "DisplayName": "Log mask", "RebootRequired": "True",
      "Bitmask": {"0": "Fast attitude", "3": "System", "1": "Medium attitude"}}},
  "json": {"version": 0}
}"#;

const PX4: &str = r#"{"version": 1, "parameters": [
  {"name": "RTL_RETURN_ALT", "type": "Float", "shortDesc": "Return altitude", "longDesc": "Above\nhome.",
   "units": "m", "min": 0, "decimalPlaces": 1, "increment": 0.5, "default": 60.0, "group": "Return Mode"},
  {"name": "NAV_RCL_ACT", "type": "Int32", "shortDesc": "RC loss action", "rebootRequired": true,
   "values": [{"value": 2, "description": "Return"}, {"value": 1, "description": "Hold"}]},
  {"name": "SDLOG_PROFILE", "type": "Int32", "shortDesc": "Log", "max": 4095,
   "bitmask": [{"index": 0, "description": "Default"}, {"index": 2, "description": "Thermal"}]}
]}"#;

fn read(text: &str) -> ParameterDocuments {
    let found = ParameterDocuments::read(text);
    assert_eq!(found.faults, []);
    found.documents
}

fn range(least: f64, most: f64) -> DocumentedRange {
    DocumentedRange { least, most }
}

#[test]
fn both_files_of_ardupilot_say_the_same() {
    let (xml, json) = (read(XML), read(JSON));
    for name in ["RTL_ALT", "FS_THR_ENABLE", "LOG_BITMASK"] {
        assert_eq!(xml.get(name), json.get(name), "{name}");
    }
    let height = xml.get("RTL_ALT").expect("documented");
    assert_eq!(
        (height.title.as_str(), height.unit.as_str()),
        ("RTL Altitude", "cm")
    );
    assert_eq!(height.description, "Height above home <before> the return.");
    assert_eq!(
        (height.range, height.increment),
        (Some(range(30.0, 300_000.0)), Some(1.0))
    );
    assert!(xml.get("LOG_BITMASK").expect("documented").needs_reboot);
    assert_eq!((xml.len(), json.len()), (4, 4));
}

#[test]
fn the_file_of_px4_is_read() {
    let found = read(PX4);
    let height = found.get("RTL_RETURN_ALT").expect("documented");
    assert_eq!(height.description, "Above home.");
    assert_eq!(height.range, Some(range(0.0, f64::INFINITY)));
    assert_eq!(height.increment, Some(0.5));
    let action = found.get("NAV_RCL_ACT").expect("documented");
    assert_eq!(action.meaning(2.0).as_deref(), Some("Return"));
    assert!(action.needs_reboot);
    let log = found.get("SDLOG_PROFILE").expect("documented");
    assert_eq!(log.meaning(5.0).as_deref(), Some("Default + Thermal"));
    assert_eq!(
        log.range.expect("has a range").text().to_string(),
        "at most 4095"
    );
}

#[test]
fn values_are_named_and_doubted() {
    let found = read(XML);
    let of = |name: &str| found.get(name).expect("documented");
    assert_eq!(of("RTL_ALT").remark(1500.0), "cm");
    assert_eq!(of("RTL_ALT").doubt(1500.0), None);
    let doubt = of("RTL_ALT").doubt(10.0).expect("it is too low");
    assert_eq!(
        doubt.text("RTL_ALT", 10.0).to_string(),
        "RTL_ALT = 10 is outside its documented range: 30 to 300000"
    );
    assert_eq!(of("FS_THR_ENABLE").remark(1.0), "Enabled always RTL");
    assert_eq!(
        of("FS_THR_ENABLE").doubt(9.0),
        Some(ParameterDoubt::NotListed)
    );
    assert_eq!(of("LOG_BITMASK").remark(9.0), "Fast attitude + System");
    assert_eq!(of("LOG_BITMASK").doubt(11.0), None);
    assert_eq!(
        of("LOG_BITMASK").doubt(4.0),
        Some(ParameterDoubt::UnknownBits)
    );
    assert_eq!(
        of("LOG_BITMASK").doubt(-1.0),
        Some(ParameterDoubt::UnknownBits)
    );
    assert_eq!(of("BARE").doubt(f64::MAX), None);
}

#[test]
fn a_fault_has_its_place_and_leaves_the_rest() {
    let places = |text: &str| -> Vec<(usize, usize)> {
        let found = ParameterDocuments::read(text);
        found
            .faults
            .iter()
            .map(|fault| fault.line_column(text))
            .collect()
    };
    let wrong = XML.replace("30 300000", "30 to 300000");
    assert_eq!(places(&wrong), [(8, 29)]);
    assert_eq!(ParameterDocuments::read(&wrong).documents.len(), 4);
    assert_eq!(
        places(&XML.replace("code=\"1\"", "code=\"one\"")),
        [(13, 29)]
    );
    assert_eq!(places(&XML.replace("</vehicles>", "</vehicle>")), [(18, 3)]);
    let cut_off = &XML[..XML.find("<libraries>").expect("it is there")];
    assert_eq!(places(cut_off), [(19, 3)]);
    assert_eq!(places(&JSON.replace("\"30\"", "\"x\"")), [(4, 5)]);
    assert_eq!(
        places(&JSON.replace("\"version\": 0", "\"version\" 0")).len(),
        1
    );
    for unreadable in ["", "RTL_ALT,1500", "{}", "<kml/>"] {
        assert_eq!(places(unreadable), [(1, 1)], "{unreadable}");
    }
}

#[test]
fn texts_cannot_move_the_cursor_of_the_terminal() {
    let found = read(&XML.replace("RTL Altitude", "RTL \u{9b}2J Altitude"));
    assert_eq!(
        found.get("RTL_ALT").expect("documented").title,
        "RTL 2J Altitude"
    );
}

proptest! {
    /// Whatever is damaged, the reader neither panics nor reports a place outside the text.
    #[test]
    fn damaged_files_are_read_without_harm(
        which in 0usize..3,
        places in proptest::collection::vec((any::<prop::sample::Index>(), "[ -~\n\u{9b}]{0,3}"), 1..6),
    ) {
        let mut text = [XML, JSON, PX4][which].to_owned();
        for (place, written) in places {
            let at = place.index(text.len());
            if text.is_char_boundary(at) && text.is_char_boundary(at + 1) {
                text.replace_range(at..=at, &written);
            }
        }
        for fault in ParameterDocuments::read(&text).faults {
            prop_assert!(fault.span.start <= text.len() && fault.span.end <= text.len());
            let (line, _) = fault.line_column(&text);
            prop_assert!(line >= 1);
        }
    }
}
