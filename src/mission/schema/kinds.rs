//! The keys of each kind of zone, hazard and action.

use super::keys::{Is, Key, SECONDS, SHARE};
use super::{Kind, may, need};

pub(super) const NAME: Is = Is::Text;
const METRES: Is = Is::Number(0.0, 20_000.0);
pub(super) const ZONE: Key = need("zone", NAME, "id of a task zone");
const GAP: Key = need(
    "min_gap",
    Is::Number(0.0, 1000.0),
    "how far apart they are at least, m",
);
pub(super) const JITTER: Key = may("jitter", METRES, "the seed moves it by up to this, m (0)");

pub(super) const ZONES: &[Kind] = &[
    ("task", &[]),
    (
        "geofence",
        &[may("ceiling", Is::Number(1.0, 10_000.0), "m")],
    ),
    (
        "no_fly",
        &[
            may("floor", Is::Number(0.0, 10_000.0), "m (0)"),
            may("ceiling", Is::Number(0.0, 10_000.0), "m (10000)"),
        ],
    ),
    (
        "gnss_jam",
        &[may(
            "edge",
            Is::Number(0.0, 1000.0),
            "where satellites go one by one, m (0)",
        )],
    ),
    (
        "gnss_glitch",
        &[need("offset", Is::Point, "how far off the shown place is")],
    ),
    (
        "people",
        &[need(
            "below",
            Is::Number(1.0, 1000.0),
            "not to be flown lower, m",
        )],
    ),
    (
        "radio_jam",
        &[
            need("noise", Is::Number(0.0, 100.0), "dB"),
            may("edge", Is::Number(0.0, 1000.0), "where it fades, m (0)"),
        ],
    ),
    (
        "comm_shadow",
        &[
            may("height", Is::Number(1.0, 5000.0), "of a ridge, m"),
            may("loss", Is::Number(0.0, 200.0), "of who is inside, dB"),
        ],
    ),
];

const SOURCE: Key = need("source", Is::Point, "where it comes out");
const OUTLET: Key = need("height", Is::Number(0.0, 500.0), "how high, m");
const RATE: Key = need("rate", Is::Number(1e-6, 1e6), "g/s");
const STABILITY: Key = need(
    "stability",
    Is::Word(&["A", "B", "C", "D", "E", "F"]),
    "of the air: A very unstable, D neutral, F stable",
);
const TERRAIN: Key = may("terrain", Is::Word(&["open", "urban"]), "(open)");
const SUBSTANCE: Key = may(
    "substance",
    Is::Word(&["vapour", "monoxide", "methane", "smoke"]),
    "(vapour)",
);
const SWAY: Key = may(
    "jitter",
    Is::Table(&[
        need("position", METRES, "m, on each axis"),
        need("rate", Is::Number(0.0, 0.9), "share of it"),
    ]),
    "what the seed changes",
);
const FUEL: Is = Is::Word(&["grass", "shrub", "timber", "bare"]);

pub(super) const HAZARDS: &[Kind] = &[
    (
        "plume",
        &[
            SOURCE,
            OUTLET,
            RATE,
            STABILITY,
            TERRAIN,
            SUBSTANCE,
            may(
                "meander",
                Is::Number(0.0, 60.0),
                "how far its axis swings, degrees (0)",
            ),
            may("intermittency", Is::Number(0.0, 2.0), "of its gusts (0)"),
            SWAY,
        ],
    ),
    (
        "puffs",
        &[
            SOURCE,
            OUTLET,
            RATE,
            STABILITY,
            TERRAIN,
            SUBSTANCE,
            may("every", Is::Number(0.2, 60.0), "s (2)"),
            SWAY,
        ],
    ),
    (
        "radiation",
        &[
            need("sources", Is::List(&Is::Table(SOURCES)), "1 to 50"),
            may("walls", Is::List(&Is::Table(WALLS)), "up to 50"),
            may("background", Is::Number(0.0, 1000.0), "uSv/h (0.1)"),
            JITTER,
        ],
    ),
    (
        "fire",
        &[
            need(
                "area",
                Is::Area,
                "[west, south, east, north], 10000 cells at most",
            ),
            need("cell", Is::Number(1.0, 100.0), "side of a cell, m"),
            may("fuel", FUEL, "what covers the ground (grass)"),
            may("patches", Is::List(&Is::Table(PATCHES)), "on top of that"),
            may("moisture", SHARE, "share of water (0.05)"),
            may(
                "embers",
                Is::Number(0.0, 1000.0),
                "times the usual ones (1)",
            ),
            need(
                "ignitions",
                Is::List(&Is::Table(IGNITIONS)),
                "where it begins",
            ),
            JITTER,
        ],
    ),
    (
        "minefield",
        &[
            ZONE,
            need("count", Is::Table(MINES), "one at least"),
            may("clutter", Is::Whole(0, 2000), "scrap (0)"),
            need(
                "min_gap",
                Is::Number(0.0, 100.0),
                "how far apart they lie, m",
            ),
        ],
    ),
    (
        "survivors",
        &[
            ZONE,
            need("count", Is::Whole(1, 100), "people"),
            may("animals", Is::Whole(0, 100), "(0)"),
            may(
                "cover",
                Is::Span,
                "share that trees hide, [low, high], 0 to 0.95",
            ),
            GAP,
            may(
                "lasts",
                Is::Number(10.0, 86_400.0),
                "how long people last, s (for ever)",
            ),
        ],
    ),
    (
        "flood",
        &[
            ZONE,
            need("houses", Is::Whole(1, 500), "how many"),
            need("people", Is::Whole(1, 500), "on roofs"),
            may("animals", Is::Whole(0, 500), "on roofs (0)"),
            GAP,
            need("roofs", Is::Span, "their heights, [low, high], m"),
            need("level", Is::Number(-20.0, 100.0), "of the water, m"),
            need("rise", Is::Number(0.0, 60.0), "m a minute"),
            may("nodes", Is::List(&Is::Point), "where gauges belong"),
        ],
    ),
    (
        "line",
        &[
            need(
                "pylons",
                Is::List(&Is::Point),
                "2 to 100, 5 m apart or more",
            ),
            need("height", Is::Number(2.0, 200.0), "of the pylons, m"),
            need("sag", Is::Number(0.0, 200.0), "of a span of mean length, m"),
            need("defects", Is::Whole(1, 200), "how many"),
            may("stains", Is::Whole(0, 200), "what looks like them (0)"),
            GAP,
        ],
    ),
];
const SOURCES: &[Key] = &[
    need("at", Is::Point, "[east, north]"),
    may("height", Is::Number(0.0, 500.0), "m (0)"),
    need("isotope", Is::Word(&["Cs-137", "Co-60"]), "what shines"),
    need("activity_gbq", Is::Number(1e-6, 1e6), "GBq"),
];
const WALLS: &[Key] = &[
    need("from", Is::Point, "[east, north]"),
    need("to", Is::Point, "[east, north]"),
    need("height", Is::Number(0.1, 500.0), "m"),
    need("passes", SHARE, "the share that gets through"),
];
const PATCHES: &[Key] = &[
    need("area", Is::Area, "[west, south, east, north]"),
    need("fuel", FUEL, "what covers it"),
];
const IGNITIONS: &[Key] = &[
    need("at", Is::Point, "[east, north]"),
    may("time", SECONDS, "s (0)"),
    may("radius", Is::Number(0.0, 1000.0), "m (0)"),
];
const MINES: &[Key] = &[
    may("metal", Is::Whole(0, 2000), "with much metal (0)"),
    may("min_metal", Is::Whole(0, 2000), "with hardly any metal (0)"),
    may("surface", Is::Whole(0, 2000), "lying open (0)"),
];

const LASTING: Key = may("for", SECONDS, "for so long, s (for good)");

pub(super) const ACTIONS: &[Kind] = &[
    (
        "say",
        &[
            need("say", Is::Text, "tells the trainee"),
            may("say_uk", Is::Text, "in Ukrainian"),
        ],
    ),
    (
        "alert",
        &[
            need(
                "alert",
                Is::Word(&["caution", "warning", "critical"]),
                "how much it matters",
            ),
            need("text", Is::Text, "what it says"),
            may("text_uk", Is::Text, "in Ukrainian"),
            may("ok", Is::Condition, "the expression that answers it"),
            may("within", Is::Number(1.0, 3600.0), "s (60, 30, 10 by level)"),
        ],
    ),
    (
        "set",
        &[
            need("set", Is::Weather, "what of the weather"),
            need("to", Is::Number(-40.0, 360.0), "its new value"),
            may("ramp", SECONDS, "little by little, s (0)"),
            LASTING,
        ],
    ),
    (
        "zone",
        &[
            need("zone", NAME, "id of a zone"),
            need("active", Is::Flag, "whether it is there"),
        ],
    ),
    (
        "spawn",
        &[
            need(
                "spawn",
                Is::Word(&["person", "aircraft", "intruder"]),
                "who",
            ),
            may("id", NAME, "what conditions call it (its kind)"),
            need("path", Is::List(&Is::Point), "2 to 100 points"),
            need("speed", Is::Number(0.1, 300.0), "m/s"),
            may("height", Is::Number(0.0, 5000.0), "m (0, 80, 30)"),
            may(
                "keep_out",
                Is::Number(0.0, 1000.0),
                "how far to stay away, m (15, 60, 15)",
            ),
            may(
                "jitter",
                Is::Number(0.0, 1000.0),
                "of the whole path, m (0)",
            ),
        ],
    ),
    (
        "fault",
        &[
            need("fault", Is::Fault, "what breaks"),
            need("vehicle", Is::Vehicle, "a number, all or random"),
            may(
                "to",
                Is::Number(-1e6, 1e6),
                "how bad, in the unit of its kind",
            ),
            LASTING,
        ],
    ),
    (
        "fail",
        &[
            need("fail", Is::Text, "the mission has failed"),
            may("fail_uk", Is::Text, "in Ukrainian"),
        ],
    ),
    ("event", &[need("event", NAME, "id of another event")]),
];
