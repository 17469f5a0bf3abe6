//! What a session of simulated vehicles is made of: where they run, and what they are.

use std::sync::Arc;

use super::client::Remote;
use super::{Config, Hangars, Launch};
use crate::scoring::{ARDUPILOT, EMBEDDED};
use crate::sim::{Airframe, Start};
use crate::text;
use crate::text::Text;

/// Where ArduPilot's SITL is started.
#[derive(Debug, Clone)]
pub enum Source {
    /// By this program.
    Own(Box<Config>),
    /// By services on this host or others.
    Far(Vec<Remote>),
}

impl Source {
    /// Opens the hangars. Must be called inside a tokio runtime.
    ///
    /// # Errors
    /// Why they cannot be opened.
    pub fn open(&self) -> Result<Hangars, Text> {
        match self {
            Self::Own(config) => {
                let folder = config.folder.display().to_string();
                let opened = super::Hangar::open((**config).clone());
                opened.map(Hangars::own).map_err(|error| {
                    text!(
                        "hangar-cannot-open",
                        folder = folder,
                        error = error.to_string()
                    )
                })
            }
            Self::Far(services) => Ok(Hangars::far(services.clone())),
        }
    }
}

/// The vehicles that are simulated.
#[derive(Debug, Clone, Default)]
pub struct Backend {
    /// ArduPilot's SITL; the embedded simulator without it.
    pub ardupilot: Option<Source>,
    /// The airframes: one for all vehicles, or one for each, the last one for all that follow.
    pub frames: Vec<Frame>,
}

/// An airframe as both simulators take it.
#[derive(Debug, Clone)]
pub struct Frame {
    /// For the embedded simulator.
    pub airframe: Arc<Airframe>,
    /// For SITL.
    pub json: serde_json::Value,
}

impl Backend {
    /// What the debrief and `--json` call it.
    pub fn name(&self) -> &'static str {
        match self.ardupilot {
            Some(_) => ARDUPILOT,
            None => EMBEDDED,
        }
    }

    /// The airframes for the embedded simulator.
    pub fn airframes(&self) -> Vec<Arc<Airframe>> {
        let frames = self.frames.iter();
        frames.map(|frame| Arc::clone(&frame.airframe)).collect()
    }

    /// What a hangar is to launch: a vehicle at each place, with system ids from 1.
    pub fn launches(&self, starts: &[Start], speedup: f64) -> Vec<Launch> {
        let systems = 1..=crate::wire::SystemId::MAX;
        let launch = |(at, (&start, system)): (usize, (&Start, u8))| Launch {
            frame: self
                .frames
                .get(at)
                .or(self.frames.last())
                .map(|frame| frame.json.clone()),
            home: start.into(),
            system: Some(system),
            speedup,
            ..Launch::default()
        };
        starts.iter().zip(systems).enumerate().map(launch).collect()
    }
}
