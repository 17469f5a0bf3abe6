//! The keys of mission files, but for those of single kinds.

/// A key of a table.
#[derive(Debug)]
pub(super) struct Key {
    pub name: &'static str,
    pub is: Is,
    pub needed: bool,
    /// For who writes it.
    pub about: &'static str,
}

/// What a value is.
#[derive(Debug)]
pub(super) enum Is {
    /// From one to the other.
    Number(f64, f64),
    Whole(u64, u64),
    Flag,
    Text,
    /// An expression.
    Condition,
    /// `[east, north]`.
    Point,
    /// `[east, north, up]`.
    Gate,
    /// `[west, south, east, north]`.
    Area,
    /// `[low, high]`.
    Span,
    /// One of these.
    Word(&'static [&'static str]),
    Sensor,
    Radio,
    Threat,
    Fault,
    Weather,
    /// A number or a word.
    Vehicle,
    List(&'static Is),
    /// Names of the writer's own, each with such a value.
    Map(&'static Is),
    Table(&'static [Key]),
}

pub(super) const fn need(name: &'static str, is: Is, about: &'static str) -> Key {
    Key {
        name,
        is,
        needed: true,
        about,
    }
}

pub(super) const fn may(name: &'static str, is: Is, about: &'static str) -> Key {
    Key {
        name,
        is,
        needed: false,
        about,
    }
}

pub(super) const SECONDS: Is = Is::Number(0.0, 86_400.0);
pub(super) const COUNT: Is = Is::Whole(0, 1000);
pub(super) const SHARE: Is = Is::Number(0.0, 1.0);
const POINTS: Is = Is::Whole(0, 1000);

pub(super) const HEAD: &[Key] = &[
    need("schema", Is::Whole(1, 1), "version of the format: 1"),
    need("id", Is::Text, "1 to 40 small letters, digits and -"),
    need(
        "rev",
        Is::Whole(0, 4_294_967_295),
        "results compare only within one",
    ),
    need("title", Is::Text, "1 to 60 characters"),
    may("title_uk", Is::Text, "the title in Ukrainian"),
    may(
        "tier",
        Is::Whole(0, 255),
        "difficulty, 0 (first steps) to 3",
    ),
    may("tags", Is::List(&Is::Text), "subjects, for lists"),
    may("authors", Is::List(&Is::Text), "who wrote it"),
    need("brief", Is::Text, "what the trainee is told before launch"),
    may("brief_uk", Is::Text, "the brief in Ukrainian"),
    may(
        "drill_of",
        Is::Text,
        "id of the mission that this is a short exercise for",
    ),
];

/// Sections whose tables have kinds are filled in by the schema.
pub(super) const SECTIONS: &[Key] = &[
    may(
        "requires",
        Is::Table(REQUIRES),
        "what has to be shown before",
    ),
    may("rewards", Is::Table(REWARDS), "what passing it brings"),
    need("sim", Is::Table(SIM), "where and for how long"),
    may(
        "weather",
        Is::Table(WEATHER),
        "wind, light; calm and day without it",
    ),
    may("places", Is::List(&Is::Table(PLACE)), "named points"),
    may("zones", Is::List(&Is::Table(ZONE)), "areas with a meaning"),
    may("hazards", Is::List(&Is::Table(KINDED)), "what is dangerous"),
    need("fleet", Is::Table(FLEET), "what flies and what it carries"),
    may("rules", Is::Table(RULES), "what vehicles must keep to"),
    need(
        "objectives",
        Is::List(&Is::Table(OBJECTIVE)),
        "what has to be reached",
    ),
    may(
        "events",
        Is::List(&Is::Table(EVENT)),
        "what happens meanwhile",
    ),
    may(
        "radio",
        Is::Table(RADIO),
        "without it, radio does not matter",
    ),
    may(
        "instructor",
        Is::Table(INSTRUCTOR),
        "what an instructor may do",
    ),
    may("hints", Is::List(&Is::Table(HINT)), "advice"),
    need("scoring", Is::Table(SCORING), "what it all is worth"),
];

const REQUIRES: &[Key] = &[
    may(
        "missions",
        Is::List(&Is::Text),
        "that have to be passed, by id",
    ),
    may(
        "medals",
        Is::Map(&Is::Word(&["bronze", "silver", "gold"])),
        "by mission: the least medal",
    ),
    may(
        "skills",
        Is::Map(&SHARE),
        "K1 to K12: how likely they have to be mastered",
    ),
];
const REWARDS: &[Key] = &[
    may(
        "credits",
        Is::Whole(0, 100_000),
        "for a perfect first pass (0)",
    ),
    may(
        "xp_tier",
        Is::Whole(0, 3),
        "that experience is counted with (its tier)",
    ),
    may(
        "unlock",
        Is::List(&Is::Text),
        "part:ID, mission:ID or threat:ID",
    ),
];
const SIM: &[Key] = &[
    need(
        "time_limit",
        Is::Number(10.0, 86_400.0),
        "mission time allowed, s",
    ),
    need("origin", Is::Table(ORIGIN), "where [0, 0] is"),
];
const ORIGIN: &[Key] = &[
    need("lat", Is::Number(-85.0, 85.0), "latitude, degrees"),
    need("lon", Is::Number(-180.0, 180.0), "longitude, degrees"),
    need("alt", Is::Number(-500.0, 9000.0), "height above the sea, m"),
    may(
        "heading",
        Is::Number(0.0, 360.0),
        "where parked vehicles look (0)",
    ),
];
const WEATHER: &[Key] = &[
    may("wind", Is::Table(WIND), "mean wind (calm)"),
    may("gust", Is::Number(0.0, 20.0), "standard deviation, m/s (0)"),
    may("temp_c", Is::Number(-40.0, 60.0), "degrees Celsius (20)"),
    may(
        "light",
        Is::Word(&["day", "dawn", "night"]),
        "what cameras see (day)",
    ),
];
const WIND: &[Key] = &[
    need("speed", Is::Number(0.0, 60.0), "m/s"),
    need(
        "dir",
        Is::Number(0.0, 360.0),
        "where it comes from, degrees",
    ),
];
const PLACE: &[Key] = &[
    need(
        "id",
        Is::Text,
        "2 to 32 letters, digits, - and _, beginning with a letter",
    ),
    need("at", Is::Point, "[east, north]"),
];
const FLEET: &[Key] = &[
    need("max_vehicles", Is::Whole(1, 250), "how many fly it"),
    need("pads", Is::List(&Is::Point), "where each stands"),
    may(
        "sensors",
        Is::List(&Is::Sensor),
        "what every vehicle carries",
    ),
    may(
        "loads",
        Is::Table(LOADS),
        "what every vehicle can let go of",
    ),
    may(
        "vehicles",
        Is::List(&Is::Table(VEHICLE)),
        "one per pad: more sensors, other loads",
    ),
    may(
        "budget",
        Is::Whole(1, 1_000_000),
        "credits for all that is flown",
    ),
    may(
        "loaner",
        Is::List(&Is::Text),
        "designs that are lent, one per pad at most",
    ),
];
const VEHICLE: &[Key] = &[
    may("sensors", Is::List(&Is::Sensor), "besides those of all"),
    may("loads", Is::Table(LOADS), "in the place of those of all"),
];
const LOADS: &[Key] = &[
    may("ball", COUNT, "extinguishing balls"),
    may("spray", COUNT, "seconds of the sprayer"),
    may("kit", COUNT, "kits for people"),
    may("node", COUNT, "sensor nodes"),
];
const RULES: &[Key] = &[
    may(
        "max_agl",
        Is::Number(1.0, 10_000.0),
        "highest height, m (120)",
    ),
    may(
        "land_reserve_pct",
        Is::Number(0.0, 100.0),
        "battery to land with, percent (20)",
    ),
    may(
        "min_separation",
        Is::Number(0.0, 1000.0),
        "between vehicles in the air, m (2)",
    ),
    may("pause", Is::Flag, "whether it may be paused (true)"),
];
const RADIO: &[Key] = &[
    need("model", Is::Radio, "the radio of every vehicle"),
    may(
        "station",
        Is::Point,
        "where the ground station is (the first pad)",
    ),
    may(
        "antenna",
        Is::Number(0.5, 100.0),
        "height of its antenna, m (2)",
    ),
    may(
        "relays",
        Is::Flag,
        "whether vehicles pass on what others send",
    ),
];
const INSTRUCTOR: &[Key] = &[may(
    "may_inject",
    Is::List(&Is::Threat),
    "what an instructor may have happen",
)];
const HINT: &[Key] = &[
    may(
        "phase",
        Is::Word(&["ground", "armed", "air", "done"]),
        "when it is shown",
    ),
    may("level", Is::Whole(1, 3), "it has to be asked for and costs"),
    may("objective", Is::Text, "until this objective is met"),
    need(
        "text",
        Is::Text,
        "what it says; {next_cell} is the next cell to sample",
    ),
    may("text_uk", Is::Text, "the same in Ukrainian"),
];
const SCORING: &[Key] = &[
    may(
        "weights",
        Is::Table(WEIGHTS),
        "of the components; they sum to 1",
    ),
    need("par", Is::Table(PAR), "what gets all points"),
    may("medals", Is::Table(MEDALS), "points needed (850, 700, 550)"),
    may(
        "gold_requires",
        Is::List(&Is::Text),
        "gates: NAME >= NUMBER, with >=, <= or ==",
    ),
];
const WEIGHTS: &[Key] = &[
    may("objective", SHARE, "what was reached"),
    may("quality", SHARE, "how good the product is"),
    may("time", SHARE, "how fast"),
    may("energy", SHARE, "how frugal"),
    may("safety", SHARE, "which rules were kept"),
    may("command", SHARE, "how clean the commands were"),
    may("attention", SHARE, "how fast alerts were answered"),
    may("utilisation", SHARE, "how well vehicles were used"),
];
const PAR: &[Key] = &[
    need("time", Is::Number(1.0, 86_400.0), "s, below the time limit"),
    need("energy_wh", Is::Number(0.01, 1e6), "Wh of all vehicles"),
];
const MEDALS: &[Key] = &[
    need("gold", POINTS, "points"),
    need("silver", POINTS, "points"),
    need("bronze", POINTS, "points"),
];

/// What every table with a kind has.
pub(super) const KINDED: &[Key] = &[
    need("id", Is::Text, "1 to 32 letters, digits, - and _"),
    need("kind", Is::Text, "what it is"),
];
pub(super) const ZONE: &[Key] = &[
    need("id", Is::Text, "1 to 32 letters, digits, - and _"),
    need("kind", Is::Text, "what it means"),
    may("polygon", Is::List(&Is::Point), "3 to 1000 corners"),
    may("center", Is::Point, "of a circle"),
    may("radius", Is::Number(0.1, 20_000.0), "of a circle, m"),
    may(
        "active",
        Is::Flag,
        "whether it is there from the start (true)",
    ),
    may(
        "jitter",
        Is::Number(0.0, 1000.0),
        "by how much the seed moves it, m (0); not of task and geofence",
    ),
];
pub(super) const OBJECTIVE: &[Key] = &[
    need("id", Is::Text, "1 to 32 letters, digits, - and _"),
    need("kind", Is::Text, "what it asks for"),
    need("title", Is::Text, "for people"),
    may("title_uk", Is::Text, "the title in Ukrainian"),
    need(
        "value",
        Is::Number(0.1, 1000.0),
        "its share of the points for objectives",
    ),
    may(
        "mandatory",
        Is::Flag,
        "whether the mission fails without it (false)",
    ),
];
pub(super) const EVENT: &[Key] = &[
    need("id", Is::Text, "what other events and conditions call it"),
    may("title", Is::Text, "what an instructor reads"),
    may("title_uk", Is::Text, "the title in Ukrainian"),
    may("at", SECONDS, "when: at this mission time, s"),
    may(
        "when",
        Is::Condition,
        "when: as this expression begins to hold",
    ),
    may("after", Is::Text, "when: after this other event"),
    may("delay", SECONDS, "so long after it, s (0)"),
    may(
        "by",
        Is::Word(&["instructor"]),
        "when: an instructor says so",
    ),
    may("once", Is::Flag, "whether it happens once at most (true)"),
    may(
        "jitter",
        SECONDS,
        "the seed moves its time by up to this, s (0)",
    ),
    may("p", SHARE, "how likely it happens (1)"),
    need("do", Is::List(&Is::Table(&[])), "what happens"),
];
