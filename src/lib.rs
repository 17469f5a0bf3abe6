//! sortie: a terminal ground-control and training console for drone swarms.
//!
//! # Code map
//!
//! Dependencies point down only, and the parts of a module depend on each other in one direction
//! only, at every depth: `tests/it/layering.rs` reads the sources and enforces both. Code that
//! other programs could also use is in libraries of the workspace (`crates/`), below everything
//! else.
//!
//! | layer | module | contents |
//! | --- | --- | --- |
//! | shell | [`cli`] | the subcommands, their options and what they print |
//! | | [`shell`] | the run loop: carries out effects, feeds events; the console without a screen (`--plain`) |
//! | | [`terminal`] | keys in, cells out: which features the terminal has, and its speed |
//! | | [`api`] | the interface for programs: their requests, and states as JSON lines |
//! | | [`replay`] | a recorded flight as the events that the console received then, starting at any moment |
//! | | [`ui`] | screens and widgets: state in, cells out; the roles of text (such as warning) and their styles (`themes/*.toml`), the colours and signs of drones |
//! | | [`app`] | state, events, effects, one `update`; the rooms' behaviour, their keys and the hints in their footers; the order of rows in the swarm table; when an alert is active, rings and is muted |
//! | input and output | [`fleet`] | a task for each vehicle, and the hub that finds it |
//! | | [`carrier`] | the connections between the seats of a class and its desk, and who is at the other end: a Unix socket, or Eclipse Zenoh for several machines (feature `zenoh`); a library in `crates/` with input and output |
//! | | [`hangar`] | SITL processes, started here or by a service over HTTP |
//! | | [`link`] | transports, reconnection, traffic meters; the embedded simulator as a server |
//! | | [`store`] | files: missions, pilots, designs, the user's theme files, settings, profiles, runs, records; what a finished or abandoned flight adds to a career |
//! | pure | [`exercise`] | when a mission begins and which clock counts its time (also in the console); a mission flown by a pilot script |
//! | | [`operator`] | from a line to the vehicles and the mission, and the outcome back to the ledger |
//! | | [`exam_plan`] | the file of an exam, and the faults in it |
//! | | [`exam_seal`] | the sealed result of a try |
//! | | [`grading`] | an instructor's grades of flights: rubrics, what the record says, and how far graders agree |
//! | | [`lesson_plan`] | the file of a lesson: its steps, and the faults in them |
//! | | [`class_results`] | the results of a class: per trainee, mission, objective and skill |
//! | | [`campaign`] | a career: unlocks, credits and experience, licences for parts, the costs of flying, the mastery of each skill, and what an attempt counts as |
//! | | [`review`] | the after-action review of a flight: answers, points to keep and to improve, later bookmarks |
//! | | [`comparison`] | two flights of a mission side by side: the positions of the other one, the differences and their cost |
//! | | [`debrief`] | a report as text |
//! | | [`mission`] | the mission file, and the referee of a flight: hazards, sensors, radio, objectives, events, separation, which hints are free, the trainee's workload, vehicles without attention |
//! | | [`scoring`] | points and their components (safety, alerts, commands, workload), the price of hints, medals, and the report of a flight |
//! | | [`fidelity`] | the simulator beside recordings of the real vehicle |
//! | | [`sitl`] | the command line and the files of one SITL process |
//! | | [`record`] | the record of a session: the frames of its links (`.tlog`), and the journal of everything else (a mission's own record is in [`mission`]) |
//! | | [`swarm`] | manoeuvres of several vehicles, the plans of a task that they share, and the default spacing of survey lines, from height and sensor |
//! | | [`session`] | the conversation with one vehicle: commands, their end and takeover, and sending them again (how often and for how long is a property of the verb, in [`language`]); plans, parameters, logs, files; which telemetry is requested, and how often; when the vehicle counts as lost |
//! | | [`forward`] | sharing links with other ground stations: the routes of frames, and the stations' commands |
//! | | [`language`] | the grammar, and the one table of verbs for vehicles, the mission and the console, with their properties: retries, danger, precedence, what `wait arrived` waits for |
//! | | [`dataflash`] | flight data from vehicle logs, aligned with a record |
//! | | [`commands`] | typed commands: when one is refused for the vehicle's state, how it is encoded, which telemetry shows its effect, and the likely reason when the vehicle refuses |
//! | | [`messages`] | telemetry: a handler for each kind of message |
//! | | [`ledger`], [`notice`], [`alert`], [`moment`] | the outcome of each command; notices to people; the kinds of alerts; the moments of a flight |
//! | | [`vehicle`] | the model of one vehicle, the grades of its readings (good, poor, bad), its fence and limits, and the battery needed to return home |
//! | | [`metadata`] | what a vehicle documents about itself: which files, and the texts of its events |
//! | | [`doctor`] | the faults of a link, such as losses, old timestamps and shared ids (`sortie doctor`, about this machine, is in [`cli`]) |
//! | | [`signing`] | the keys of MAVLink signing and the console's timestamps |
//! | | [`inspector`] | messages, counted and decoded field by field, and built from fields by name |
//! | | [`parameters`] | parameter lists, files, differences, and which parameters belong to one vehicle and are not copied |
//! | | [`workshop`] | parts, designs, and the performance of a design, such as endurance and radio range |
//! | | [`config`] | settings and the source of each; the columns of the swarm table |
//! | | [`diagnostic`] | faults in files and lines, with place and advice |
//! | | [`draft`] | plans, fences and rally points that are being drawn: every change, undo, legs and heights |
//! | | [`preflight`] | plan files before a flight: faults, notes and findings in words |
//! | | [`text`](mod@text) | messages in the user's language (`locales/`) |
//! | | [`class_text`] | the orders of an instructor's desk, as text |
//! | | [`verb`] | the types of a verb's properties; their values are in the table of [`language`] |
//! | | [`crew`] | several people on one swarm: members, roles, hand-overs, and the lines between host and members |
//! | | [`pilot_in_command`] | who flies a vehicle, and whose commands it therefore refuses |
//! | | [`vehicle_id`] | the numbers of vehicles, and sets of them (`1-4,7`) |
//! | | [`hash`] | a hash that never changes |
//! | libraries | [`class`] | a class: what seats report to the instructor's desk, its orders, and what survives a broken connection |
//! | | [`rehearsal`] | plans of several vehicles flown in simulation: times, batteries, closest approaches |
//! | | [`sim`] | simulated vehicles, their batteries and radios, and the wind |
//! | | [`wire`] | MAVLink frames |
//! | | [`plan`] | items of plans, fences and rally points: their files, the faults in them, and estimates of time and energy |
//! | | [`geo`] | positions and maps |
//!
//! # A telemetry packet
//! [`link`] reads bytes, [`wire`] finds frames and counts what it drops, and the hub of [`fleet`]
//! passes the frames to the vehicle's task. Its [`session`] passes each frame to [`messages`],
//! which changes the [`vehicle`] model in place, and then to the command under way, which looks for
//! its answer and its effect. Once per tick, the console takes a snapshot of what has changed.
//!
//! # A keypress
//! Event, [`app::App::update`], effect: [`language`] reads the palette's line. The app carries out
//! commands to the console itself. From any other line, the [`operator`] makes an
//! [`Order`](commands::Order), and the [`ledger`] opens a row per target. The [`shell`] passes the
//! order to the [`operator`], which decides what follows for each vehicle and for the mission. Each
//! vehicle's session sends, waits, retries, and watches telemetry for the effect.
//!
//! A command can be refused at three places before it is sent: when its line is read ([`language`]),
//! for the state of the vehicle ([`commands`]), and for the vehicle's parameters (`fit` in
//! [`session`]).
//!
//! # The end of a flight
//! A mission's [`exercise`] ends with a report of [`scoring`], and [`store`] adds it to the career
//! ([`campaign`] decides what it counts as). A mission is never resumed by another run of the
//! program: the record of a killed one is stored as left early, at the next start. Pauses, also by
//! Ctrl-Z, are in the [`shell`].
//!
//! # Invariants
//! - Pure modules use no clock, no randomness, no files and no sockets: `now` and seeds are
//!   arguments.
//! - Only [`app::App::update`] changes what the console shows: the fields of [`app::State`] and of
//!   its parts are private to [`app`], and everything else reads them through methods.
//! - The shell feeds every event through one queue, and carries out every resulting effect.
//! - The same [`session`] runs in the console's tasks and in the lock step of an exercise, and the
//!   same [`operator`] carries out the orders of both.
//! - State goes through `watch`, occurrences through bounded `mpsc`, shutdown through a
//!   cancellation token.
//! - Nothing queues without bound; telemetry merges when the terminal is slow.
//! - Text from a vehicle is cleaned of control characters before it reaches the model.

pub mod alert;
pub mod api;
pub mod app;
pub mod campaign;
pub mod class_results;
pub mod class_text;
pub mod cli;
pub mod commands;
pub mod comparison;
pub mod config;
pub mod crew;
pub mod dataflash;
pub mod debrief;
pub mod diagnostic;
pub mod doctor;
pub mod draft;
pub mod exam_plan;
pub mod exam_seal;
pub mod exercise;
pub mod fidelity;
pub mod fleet;
pub mod forward;
pub mod grading;
pub mod hangar;
pub mod hash;
pub mod inspector;
pub mod language;
pub mod ledger;
pub mod lesson_plan;
pub mod link;
pub mod messages;
pub mod metadata;
pub mod mission;
pub mod moment;
pub mod notice;
pub mod operator;
pub mod parameters;
pub mod pilot_in_command;
pub mod preflight;
pub mod record;
pub mod replay;
pub mod review;
pub mod scoring;
pub mod session;
pub mod shell;
pub mod signing;
pub mod sitl;
pub mod store;
pub mod swarm;
pub mod terminal;
pub mod text;
pub mod ui;
pub mod vehicle;
pub mod vehicle_id;
pub mod verb;
pub mod workshop;

pub use sortie_carrier as carrier;
pub use sortie_class as class;
pub use sortie_geo as geo;
pub use sortie_plan as plan;
pub use sortie_rehearsal as rehearsal;
pub use sortie_sim as sim;
pub use sortie_wire as wire;
