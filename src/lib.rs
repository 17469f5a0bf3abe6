//! sortie: a terminal ground-control and training console for drone swarms.
//!
//! # Code map
//! Dependencies point down only, and the parts of a module depend on each other one way only:
//! `tests/it/layering.rs` reads the sources and enforces both. It looks at modules and their direct parts. What other
//! programs could use as well is in libraries of the workspace, below everything else.
//!
//! | layer | module | home of |
//! | --- | --- | --- |
//! | shell | [`cli`] | the subcommands, their options and what they print |
//! | | [`shell`] | the run loop: carries out effects, feeds events; the console without a screen (`--plain`) |
//! | | [`terminal`] | keys in, cells out: which features the terminal has, and how fast it is |
//! | | [`replay`] | a recorded flight as the events that the console saw then; from any moment on |
//! | | [`ui`] | screens and widgets: state in, cells out |
//! | | [`app`] | state, events, effects, key bindings, the rooms' behaviour, one `update`; when an alert holds, rings and is muted |
//! | input and output | [`fleet`] | a task for each vehicle, and the hub that finds it |
//! | | [`hangar`] | SITL processes: started here, or by a service over HTTP |
//! | | [`link`] | transports, reconnection, traffic meters; the embedded simulator as a server |
//! | | [`store`] | files: missions, pilots, designs, themes, settings, profiles, runs, records |
//! | pure | [`exercise`] | when a mission begins and by whose clock its time passes (in the console, too); a mission flown by a pilot script |
//! | | [`operator`] | from a line to the vehicles, and back to the ledger |
//! | | [`campaign`] | a career: what is unlocked, earned and owned, how surely each skill is mastered, and what a try counts for |
//! | | [`review`] | the after-action review of a flight: answers, points to keep and to improve, later bookmarks |
//! | | [`comparison`] | two flights of a mission side by side: where the other one was, what differed, what it cost |
//! | | [`debrief`] | a report as text |
//! | | [`mission`] | what a mission file says, and the flight's referee: hazards, sensors, radio, objectives, events |
//! | | [`scoring`] | marks, medals, and the report of a flight |
//! | | [`fidelity`] | the simulator beside recordings of the real vehicle |
//! | | [`sitl`] | the command line and the files of one SITL process |
//! | | [`record`] | what a session leaves beside the frames of its links: the journal (a mission's own record is in [`mission`]) |
//! | | [`swarm`] | manoeuvres of several vehicles |
//! | | [`session`] | the conversation with one vehicle: commands, sent again as their verb says, and when they end or are overtaken; plans, parameters, logs, files; when it counts as lost |
//! | | [`language`] | the grammar, and the one table of verbs: to vehicles, to the mission, to the console; with each one's values: retries, danger, precedence, what `wait arrived` waits for |
//! | | [`dataflash`] | flight data from vehicle logs, aligned with a record |
//! | | [`commands`] | typed commands: when one is refused, how it is encoded, and what telemetry shows that it is done |
//! | | [`messages`] | telemetry: a handler for each kind of message |
//! | | [`ledger`], [`notice`], [`alert`], [`moment`] | what became of each command; what is said to people; the kinds of alerts; what is worth coming back to |
//! | | [`vehicle`] | the model of one vehicle, and what its way home takes of the battery |
//! | | [`doctor`] | what is wrong with a link (`sortie doctor`, about this machine, is in [`cli`]) |
//! | | [`inspector`] | messages counted, and taken apart field by field |
//! | | [`parameters`] | parameter lists, files, differences |
//! | | [`workshop`] | parts, designs, and what a design can do: how long it flies, how far its radio reaches |
//! | | [`config`] | settings and where each came from |
//! | | [`diagnostic`] | faults in files and lines, with place and advice |
//! | | [`text`](mod@text) | messages in the user's language (`locales/`) |
//! | | [`verb`] | the types of a verb's properties; their values are in the table of [`language`] |
//! | | [`hash`] | a hash that stays the same |
//! | libraries | [`sim`] | simulated vehicles |
//! | | [`wire`] | MAVLink frames |
//! | | [`plan`] | items of plans, fences and rally points: their files, and the faults in them |
//! | | [`geo`] | positions and maps |
//!
//! # A telemetry packet
//! [`link`] reads bytes, [`wire`] finds frames and counts what it drops, the hub of [`fleet`] gives the frames
//! to the vehicle's task, whose [`session`] gives each to [`messages`], which changes the [`vehicle`] model in place, and
//! then to the command under way, which looks for its answer and its effect. The console takes a snapshot of what changed once per tick.
//!
//! # A keypress
//! Event, [`app::App::update`], effect: [`language`] reads the palette's line. The app carries out what is said to the
//! console itself; of the rest the [`operator`] makes an [`Order`](commands::Order), and the [`ledger`] opens a row per
//! target. The [`shell`] gives the order to the [`operator`], which decides what follows for each vehicle and for the
//! mission; each vehicle's session sends, waits, retries, and watches telemetry for the effect.
//!
//! # Invariants
//! - Pure modules have no clock, no randomness of their own, no files and no sockets: `now` and seeds are arguments.
//! - Only [`app::App::update`] changes what the console shows: the fields of [`app::State`] and of its parts are private
//!   to [`app`], and everything else reads them through methods.
//! - The shell feeds every event through one queue, and carries out every effect that comes of it.
//! - The same [`session`] runs in the console's tasks and in the lock step of an exercise, and the same [`operator`]
//!   carries out the orders of both.
//! - State goes through `watch`, occurrences through bounded `mpsc`, shutdown through a cancellation token.
//! - Nothing queues without bound; telemetry merges when the terminal is slow.
//! - Text from a vehicle is cleaned of control characters before it reaches the model.

pub mod alert;
pub mod app;
pub mod campaign;
pub mod cli;
pub mod commands;
pub mod comparison;
pub mod config;
pub mod dataflash;
pub mod debrief;
pub mod diagnostic;
pub mod doctor;
pub mod exercise;
pub mod fidelity;
pub mod fleet;
pub mod hangar;
pub mod hash;
pub mod inspector;
pub mod language;
pub mod ledger;
pub mod link;
pub mod messages;
pub mod mission;
pub mod moment;
pub mod notice;
pub mod operator;
pub mod parameters;
pub mod record;
pub mod replay;
pub mod review;
pub mod scoring;
pub mod session;
pub mod shell;
pub mod sitl;
pub mod store;
pub mod swarm;
pub mod terminal;
pub mod text;
pub mod ui;
pub mod vehicle;
pub mod verb;
pub mod workshop;

pub use sortie_geo as geo;
pub use sortie_plan as plan;
pub use sortie_sim as sim;
pub use sortie_wire as wire;
