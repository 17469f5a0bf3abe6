//! Faults of the newer sections: each one a change of the valid mission, with the resulting refusal.

use sortie::mission::Mission;

use super::folder;

/// The replaced text of the valid file, its replacement, and the resulting faults.
const REFUSALS: &[(&str, &str, &str)] = &[
    (
        "[scoring]",
        "[[crew]]\nrole = \"cook\"\n[scoring]",
        "50:8: unknown role `cook`; known: pilot, sensors, safety",
    ),
    (
        "[scoring]",
        "[[crew]]\nrole = \"pilot\"\nvehicles = \"1-2\"\n[scoring]",
        "51:12: no vehicle 2: the fleet has 1",
    ),
    (
        "[scoring]",
        "[[crew]]\nrole = \"pilot\"\nvehicles = \"1\"\n[[crew]]\nrole = \"pilot\"\nvehicles = \"1\"\n[scoring]",
        "54:12: 1 has a pilot already",
    ),
    (
        "[scoring]",
        "[[crew]]\nrole = \"safety\"\nvehicles = \"1\"\n[scoring]",
        "51:12: `safety` flies no vehicles: leave `vehicles` out",
    ),
    (
        "sensors = [\"s_voc\"]",
        "sensors = [\"s_voc\"]\nloads = { bal = 4 }",
        "27:11: unknown field `bal`; known: ball, spray, kit, node (did you mean `ball`?)",
    ),
    (
        "sensors = [\"s_voc\"]",
        "sensors = [\"s_voc\"]\nloads = { ball = 4000 }",
        "27:18: `ball` must lie between 0 and 1000",
    ),
    (
        "sensors = [\"s_voc\"]",
        "sensors = [\"s_voc\"]\nvehicles = [{}, { loads = { kit = 1 } }]",
        "27:12: `vehicles` has 2 entries for 1 pads: write one for each",
    ),
    (
        "max_vehicles = 1",
        "max_vehicles = 1.5",
        "24:16: expected a whole number, 0 or more, not `1.5`",
    ),
    (
        "[scoring]",
        "[rewards]\nunlock = [\"part:s_pm25\", \"part:s_ball\", \"part:r_mesh24\", \"part:fr_500q\"]\ncredits = -1\n[scoring]",
        "51:11: expected a whole number, 0 or more, not `-1`",
    ),
    (
        "brief = \"Bad.\"",
        "brief = \"Bad.\"\ndrill_of = \"bad\"",
        "6:12: a mission cannot be its own drill",
    ),
    (
        "brief = \"Bad.\"",
        "brief = \"Bad.\"\ndrill_of = \"Air Sample\"",
        "6:12: a mission's id is 1 to 40 lower-case letters, digits and `-`",
    ),
    (
        "[fleet]",
        "[[places]]\nid = \"n\"\nat = [0, 0]\n[fleet]",
        "24:6: a place's id begins with a letter: 2 to 32 letters, digits, `-` and `_`",
    ),
    (
        "[fleet]",
        "[[places]]\nid = \"pad2\"\nat = [0, 0]\n[fleet]",
        "24:6: `pad`, `pad1`, `c1`, `fire1`, `gate1`, `peak`, `peak1` and `next` are names of the flight's own places",
    ),
    (
        "[fleet]",
        "[[places]]\nid = \"peak1\"\nat = [0, 0]\n[fleet]",
        "24:6: `pad`, `pad1`, `c1`, `fire1`, `gate1`, `peak`, `peak1` and `next` are names of the flight's own places",
    ),
    (
        "[fleet]",
        "[[places]]\nid = \"A1\"\nat = [0, 0]\n[fleet]",
        "24:6: `A1` is a cell of `cells`",
    ),
    (
        "[fleet]",
        "[[places]]\nid = \"mast\"\nat = [0, 90000]\n[fleet]",
        "25:6: `at` must lie within 20000 m of the origin, as [east, north]",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"gates\"\ngates = []\nradius = 5\n[scoring]",
        "54:9: `gates` must have 1 to 100 entries",
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
        "54:10: `places` must have 1 to 100 entries",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"hover\"\nheights = [5, 2]\nradius = 5\ntime = 5\n[scoring]",
        "54:11: `heights` must be a list of two ascending numbers, 0 to 1000 m",
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
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"gates\"\ngates = [[0, 0, 5]]\nradius = 5\n[[objectives]]\nid = \"p\"\ntitle = \"P\"\nvalue = 1\nkind = \"gates\"\ngates = [[0, 9, 5]]\nradius = 5\n[scoring]",
        "57:6: an earlier objective has gates already (place `gate1`): only one objective may have gates",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"kept\"\n[scoring]",
        "53:8: this kind needs `plans` in `[board]`",
    ),
    (
        "[fleet]",
        "[board]\nfaulty = 1\nfaults = [\"gap\"]\n[fleet]",
        "24:10: more faulty plans than `plans` or `faults`",
    ),
    (
        "[fleet]",
        "[board]\nplans = [{ up = 10, places = [[0, 1], [0, 2], [0, 3], [0, 4]] }]\nfaulty = 1\nfaults = [\"copied\"]\n[fleet]",
        "26:10: `copied` needs two vehicles",
    ),
    (
        "[scoring]",
        "[[events]]\nid = \"e\"\nat = 1\ndo = [{ alert = \"warning\", vehicle = 2, text = \"hot\" }]\n[scoring]",
        "52:38: `vehicle` is a number from 1 to 1",
    ),
    (
        "[fleet]",
        "[requires]\nskills = { K14 = 0.5 }\n[fleet]",
        "24:12: unknown skill `K14`; known: K1, K2, K3, K4, K5, K6, K7, K8, K9, K10, K11, K12, K13 (did you mean `K1`?)",
    ),
    (
        "[fleet]",
        "[requires]\nmissions = [\"Lane 7\"]\n[fleet]",
        "24:13: a mission's id is 1 to 40 lower-case letters, digits and `-`",
    ),
    (
        "[fleet]",
        "[requires]\nmedals = { lane = \"tin\" }\n[fleet]",
        "24:19: unknown value `tin`; known: bronze, silver, gold",
    ),
    (
        "[fleet]",
        "[rewards]\nunlock = [\"s_gpr\"]\n[fleet]",
        "24:11: write `part:ID`, `mission:ID`, `threat:ID` or `vehicle:KIND`",
    ),
    (
        "[fleet]",
        "[rewards]\nunlock = [\"vehicle:robt\"]\n[fleet]",
        "24:11: unknown kind of vehicle `robt`; known: robot, boat (did you mean `robot`?)",
    ),
    (
        "[fleet]",
        "[rewards]\ncredits = 100001\n[fleet]",
        "24:11: `credits` must lie between 0 and 100000",
    ),
    (
        "[fleet]",
        "[fleet]\nbudget = 0",
        "24:10: `budget` must lie between 1 and 1000000",
    ),
    (
        "[fleet]",
        "[fleet]\nloaner = [\"scout-450\", \"scout-450\"]",
        "24:10: `loaner` lends at most one design for each pad",
    ),
];

/// Changes with faults that appear only in the context of the whole file.
const FAULTS_OF_SENSE: &[(&str, &str, &str)] = &[
    (
        "[fleet]",
        "[board]\nplans = [{ up = 10, places = [[0, 20], [0, 40], [0, 200], [0, 60]] }]\n[fleet]",
        "29:49: this place lies beyond the fence `fence`",
    ),
    (
        "[fleet]",
        "[board]\nplans = [{ up = 61, places = [[0, 20], [0, 40], [0, 90], [0, 60]] }]\n[fleet]",
        "29:17: this plan is above the limit of 60 m",
    ),
    (
        "sensors = [\"s_voc\"]",
        "sensors = [\"s_voc\"]\nbudget = 942",
        "32:10: `budget` is too small: the cheapest fleet with these sensors and loads costs 943 credits",
    ),
    (
        "sensors = [\"s_voc\"]",
        "sensors = [\"s_voc\"]\nbudget = 1312\nloads = { ball = 1, kit = 1, spray = 30 }",
        "32:10: `budget` is too small: the cheapest fleet with these sensors and loads costs 1313 credits",
    ),
    (
        "pads = [[0, 0]]",
        "pads = [[0, 500]]",
        "30:9: pad 1 lies beyond the fence `fence`",
    ),
    (
        "max_vehicles = 1\npads = [[0, 0]]",
        "max_vehicles = 2\npads = [[0, 0], [1, 0]]",
        "30:17: this pad is 1.0 m from another one; vehicles must keep 2 m apart",
    ),
    (
        "[30, 90], [-30, 90]",
        "[30, 190], [-30, 190]",
        "36:8: the zone `yard` reaches beyond the fence `fence`",
    ),
    (
        "heights = [15, 40]",
        "heights = [60, 80]",
        "41:11: all these heights lie above the highest allowed, 60 m",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"gates\"\ngates = [[0, 0, 70]]\nradius = 5\n[scoring]",
        "59:10: this gate lies above the highest height allowed, 60 m",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"gates\"\ngates = [[0, 300, 9]]\nradius = 5\n[scoring]",
        "59:10: this gate lies beyond the fence `fence`",
    ),
    (
        "[scoring]",
        "[[events]]\nid = \"late\"\nat = 480\ndo = [{ say = \"Late.\" }]\n[scoring]",
        "56:6: the mission is over before this happens",
    ),
    (
        "[scoring]",
        "[[objectives]]\nid = \"o\"\ntitle = \"O\"\nvalue = 1\nkind = \"hover\"\nheights = [5, 9]\nradius = 5\ntime = 500\n[scoring]",
        "61:8: the mission lasts only 480 s",
    ),
    (
        "[scoring]",
        "[scoring]\ngold_requires = [\"safety >= 1.5\"]",
        "55:18: no flight can reach this",
    ),
    (
        "[scoring]",
        "[scoring]\nweights = { objective = 0.9, attention = 0.1 }",
        "55:42: no alert of this mission has an `ok` that answers it",
    ),
    (
        "dwell = 5",
        "dwell = 70",
        "36:8: at 10 m/s in straight lines this takes 563 s, but the mission lasts 480 s",
    ),
    (
        "[scoring]",
        "[[events]]\nid = \"x\"\nafter = \"x\"\ndo = [{ say = \"X.\" }]\n[scoring]",
        "56:9: `x` waits for itself and never happens",
    ),
    (
        "[scoring]",
        "[[events]]\nid = \"x\"\nafter = \"y\"\ndo = [{ say = \"X.\" }]\n[[events]]\nid = \"y\"\nafter = \"x\"\ndo = [{ say = \"Y.\" }]\n[[events]]\nid = \"z\"\nafter = \"y\"\ndo = [{ say = \"Z.\" }]\n[scoring]",
        "56:9: these events wait for one another and never happen: `x` after `y`",
    ),
    (
        "[[hazards]]",
        "[[zones]]\nid = \"noise\"\nkind = \"radio_jam\"\ncenter = [0, 0]\nradius = 9\nnoise = 20\n[[hazards]]",
        "23:8: a `radio_jam` needs the section `radio`: without it nothing is jammed",
    ),
    (
        "[[hazards]]",
        "[[zones]]\nid = \"bow\"\nkind = \"task\"\npolygon = [[0, 0], [9, 0], [0, 9], [9, 9]]\n[[hazards]]",
        "24:11: the polygon crosses itself: the side between corners 2 and 3 crosses the side between corners 4 and 1",
    ),
    (
        "[[hazards]]",
        "[[zones]]\nid = \"school\"\nkind = \"no_fly\"\npolygon = [[-40, 20], [28, 20], [28, 99], [-40, 99]]\n[[hazards]]",
        "40:8: flying is forbidden over more than nine tenths of the zone `yard`: `school`",
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

/// The mission with a fence, so that objects can lie beyond it.
fn fenced() -> String {
    good().replace(
        "[[hazards]]",
        "[[zones]]\nid = \"fence\"\nkind = \"geofence\"\npolygon = [[-50, -20], [50, -20], [50, 120], [-50, 120]]\nceiling = 60\n[[hazards]]",
    )
}

#[test]
fn what_cannot_be_flown_as_it_is_meant_is_named_at_its_place() {
    let fenced = fenced();
    let found = |source: &str| -> Vec<String> {
        let mission = Mission::parse(source).unwrap_or_else(|faults| panic!("{faults:?}"));
        let faults = mission.check().into_iter();
        let lines = faults.map(|fault| fault.one_line("", source));
        lines
            .map(|line| line.trim_start_matches(':').to_owned())
            .collect()
    };
    let before = "[[hazards]]";
    let fine = [
        // Another event starts the cycle.
        "[[events]]\nid = \"x\"\nafter = \"y\"\ndo = [{ say = \"X.\" }]\n[[events]]\nid = \"y\"\nafter = \"x\"\ndo = [{ say = \"Y.\" }]\n[[events]]\nid = \"z\"\nat = 9\ndo = [{ event = \"x\" }]\n",
        // A zone that is flown over, switched off, or covers only a part.
        "[[zones]]\nid = \"low\"\nkind = \"no_fly\"\npolygon = [[-40, 20], [28, 20], [28, 99], [-40, 99]]\nceiling = 30\n",
        "[[zones]]\nid = \"late\"\nkind = \"no_fly\"\nactive = false\npolygon = [[-40, 20], [28, 20], [28, 99], [-40, 99]]\n",
        "[[zones]]\nid = \"part\"\nkind = \"no_fly\"\npolygon = [[-40, 20], [20, 20], [20, 99], [-40, 99]]\n",
    ];
    for extra in fine {
        let source = fenced.replace(before, &format!("{extra}{before}"));
        assert_eq!(found(&source), Vec::<String>::new(), "{extra}");
    }
    let affordable = [
        "",
        "\nbudget = 943",
        "\nbudget = 1\nloaner = [\"scout-450\"]",
    ];
    for fleet in affordable {
        let sensors = "sensors = [\"s_voc\"]";
        let source = fenced.replace(sensors, &format!("{sensors}{fleet}"));
        assert_eq!(found(&source), Vec::<String>::new(), "{fleet}");
    }
    for &(old, new, expected) in FAULTS_OF_SENSE {
        assert_eq!(fenced.matches(old).count(), 1, "{old}");
        assert_eq!(found(&fenced.replace(old, new)), [expected], "{new}");
    }
}

#[test]
fn a_section_has_no_more_tables_than_a_mission_can_use() {
    let place = |index: usize| format!("[[places]]\nid = \"at-{index}\"\nat = [0, 0]\n");
    let places: String = (0..201).map(place).collect();
    let source = good().replace("[scoring]", &format!("{places}[scoring]"));
    let faults = Mission::parse(&source).expect_err("too many");
    let line = faults[0].one_line("m", &source);
    assert!(
        line.starts_with("m:649:1: too many: a mission has at most 200"),
        "{line}"
    );
    assert_eq!(faults.len(), 1);
}

#[test]
fn texts_and_conditions_have_a_greatest_length() {
    let brief = format!("brief = \"{}\"", "x".repeat(8001));
    let source = good().replace("brief = \"Bad.\"", &brief);
    let faults = Mission::parse(&source).expect_err("too long");
    assert_eq!(
        faults[0].one_line("m", &source),
        "m:5:9: text may have at most 8000 bytes"
    );
    let sum = "1 + ".repeat(300);
    let event = format!(
        "[[events]]\nid = \"e\"\nwhen = \"{sum}1 > t\"\ndo = [{{ say = \"E.\" }}]\n[scoring]"
    );
    let source = good().replace("[scoring]", &event);
    let faults = Mission::parse(&source).expect_err("too long");
    assert_eq!(
        faults[0].one_line("m", &source),
        "m:51:8: a condition has at most 1000 characters"
    );
}

#[test]
fn sensors_loads_and_radios_are_unlocked_that_the_catalogue_has() {
    let faults = |part: &str| {
        let source = format!("{}\n[rewards]\nunlock = [\"part:{part}\"]\n", good());
        let faults = Mission::parse(&source).err().unwrap_or_default();
        let lines = faults.iter().map(|fault| fault.one_line("", &source));
        lines.collect::<String>()
    };
    for part in ["s_pm25", "s_ball", "r_mesh24", "fr_500q", "gps_crpa"] {
        assert_eq!(faults(part), "", "{part}");
    }
    for (part, meant) in [
        ("s_pm24", "s_pm25"),
        ("r_mesh25", "r_mesh24"),
        ("fr_501q", "fr_500q"),
    ] {
        let said = faults(part);
        assert!(said.contains(&format!("unknown part `{part}`")), "{said}");
        assert!(said.contains(&format!("did you mean `{meant}`?")), "{said}");
    }
}
