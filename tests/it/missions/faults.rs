//! Faults of the newer sections: each one a change of the good mission, with the fault that it is refused with.

use sortie::mission::Mission;

use super::folder;

/// What is replaced in the good file, by what, and the faults that follow.
const REFUSALS: &[(&str, &str, &str)] = &[
    (
        "sensors = [\"s_voc\"]",
        "sensors = [\"s_voc\"]\nloads = { bal = 4 }",
        "27:11: unknown field `bal`, expected one of `ball`, `spray`, `kit`, `node` (did you mean `ball`?)",
    ),
    (
        "sensors = [\"s_voc\"]",
        "sensors = [\"s_voc\"]\nloads = { ball = 4000 }",
        "27:18: `ball` must lie between 0 and 1000",
    ),
    (
        "sensors = [\"s_voc\"]",
        "sensors = [\"s_voc\"]\nvehicles = [{}, { loads = { kit = 1 } }]",
        "27:12: `vehicles` has 2 for 1 pads: one each",
    ),
    (
        "brief = \"Bad.\"",
        "brief = \"Bad.\"\ndrill_of = \"bad\"",
        "6:12: a mission is no drill of itself",
    ),
    (
        "brief = \"Bad.\"",
        "brief = \"Bad.\"\ndrill_of = \"Air Sample\"",
        "6:12: a mission's id is 1 to 40 small letters, digits and `-`",
    ),
];

fn good() -> String {
    std::fs::read_to_string(folder("tests/data/good_mission.toml")).expect("it is there")
}

#[test]
fn each_fault_of_a_section_is_named_at_its_place_and_nothing_else_is() {
    let good = good();
    for &(old, new, expected) in REFUSALS {
        assert_eq!(good.matches(old).count(), 1, "{old}");
        let source = good.replace(old, new);
        let faults = Mission::parse(&source).err().unwrap_or_default();
        let lines = faults.iter().map(|fault| fault.one_line("", &source));
        let found: Vec<String> = lines
            .map(|line| line.trim_start_matches(':').to_owned())
            .collect();
        assert_eq!(found, [expected], "{new}");
    }
}
