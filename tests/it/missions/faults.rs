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
    (
        "[fleet]",
        "[[places]]\nid = \"n\"\nat = [0, 0]\n[fleet]",
        "24:6: a place's id begins with a letter: 2 to 32 letters, digits, `-` and `_`",
    ),
    (
        "[fleet]",
        "[[places]]\nid = \"pad2\"\nat = [0, 0]\n[fleet]",
        "24:6: `pad`, `pad1`, `c1`, `gate1`, `peak` and `next` are names of the flight's own places",
    ),
    (
        "[fleet]",
        "[[places]]\nid = \"mast\"\nat = [0, 90000]\n[fleet]",
        "25:6: `at` must lie within 20000 m of the origin, as [east, north]",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"gates\"\ngates = []\nradius = 5\n[scoring]",
        "54:9: `gates` must have 1 to 100 of them",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"gates\"\ngates = [[0, 0, -1]]\nradius = 5\n[scoring]",
        "54:10: a gate is [east, north, up]: within 20000 m of the origin, 0 to 1000 m high",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"visit\"\nplaces = [\"pad2\"]\nradius = 5\n[scoring]",
        "54:11: unknown place `pad2`; known: pad1 (did you mean `pad1`?)",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"visit\"\nplaces = [\"pad1\", \"pad1\"]\nradius = 5\n[scoring]",
        "54:19: this place is named twice",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"visit\"\nplaces = []\nradius = 5\n[scoring]",
        "54:10: `places` must name 1 to 100 places",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"hover\"\nheights = [5, 2]\nradius = 5\ntime = 5\n[scoring]",
        "54:11: `heights` must be [low, high], 0 to 1000 m",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"arm_time\"\nwithin = 0\n[scoring]",
        "54:10: `within` must lie between 1 and 3600, not 0",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"land_on\"\nplace = \"pad1\"\nradius = 3\ncount = 2\n[scoring]",
        "56:9: `count` must lie between 1 and the 1 vehicles of the fleet",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"formation\"\ngates = [[0, 0, 5]]\nradius = 3\nspacing = [1, 2]\ntarget = 0.5\npartial_from = 0.2\n[scoring]",
        "49:1: a formation needs two vehicles or more",
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
