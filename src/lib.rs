//! sortie: a terminal ground-control and training console for drone swarms.
//!
//! # Code map
//! Dependencies point down only; a test reads the `use` lines and enforces it. What others can use as well are
//! libraries of the workspace, below everything else: [`geo`], [`wire`] and [`sim`].
//!
//! | layer | modules |
//! | --- | --- |
//! | shell | [`cli`] (subcommands), [`console`] (the run loop), [`terminal`], [`ui`] (screens: state in, cells out), [`app`] (state, event, effect, one `update`) |
//! | input and output | [`fleet`] (a task per vehicle), [`hangar`] (SITL processes, here or by HTTP), [`link`] (transports, and the simulator as a server), [`store`] (files) |
//! | pure | [`exercise`] (a mission flown by a pilot script), [`operator`] (from a line to the vehicles), [`fidelity`] (the simulator beside recordings), [`debrief`], [`scoring`], [`mission`], [`sitl`] (the command line of one SITL), [`session`] (the conversation with one vehicle), [`language`] (the grammar), [`commands`], [`verb`] (what is known about a verb), [`messages`] (telemetry handlers), [`ledger`], [`notice`], [`vehicle`] (the model), [`parameters`] (lists, files, differences), [`doctor`] (what ails a link), [`inspector`] (messages counted and taken apart), [`diagnostic`] |
//! | libraries | [`sim`] (simulated vehicles), [`wire`] (frames), [`geo`] (positions and maps) |
//!
//! # A telemetry packet
//! [`link`] reads bytes, [`wire`] finds frames and counts what it drops, the hub of [`fleet`] gives the frames
//! to the vehicle's task, whose [`session`] offers them to the command under way and to [`messages`], which
//! changes the [`vehicle`] model in place. The console takes a snapshot of what changed once per tick.
//!
//! # A keypress
//! Event, [`app::App::update`], effect: the palette's line is read by [`language`] into an [`Order`](commands::Order); the
//! [`ledger`] opens a row per target; the [`operator`] decides what follows for each vehicle and for the mission; each
//! vehicle's session sends, waits, retries, and watches telemetry for the effect.
//!
//! # Invariants
//! - Pure modules have no clock, no randomness of their own, no files and no sockets: `now` and seeds are arguments.
//! - Only [`app::App::update`] changes what the console shows. The shell reads the state, and feeds every event through
//!   one queue, so that no effect is dropped.
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
pub mod config;
pub mod console;
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
pub mod notice;
pub mod operator;
pub mod parameters;
pub mod scoring;
pub mod session;
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
pub use sortie_sim as sim;
pub use sortie_wire as wire;
