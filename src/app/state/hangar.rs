//! The processes that simulate the vehicles.

pub use crate::sitl::SitlStage;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// A process and the vehicle that it simulates.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    pub vehicle: VehicleId,
    /// The service that it runs by; `None` is this program.
    pub host: Option<String>,
    /// How far it has come.
    pub stage: SitlStage,
    /// How many parameters have come, and how many there are; 0 while that is unknown.
    pub parameters: [u16; 2],
    /// The process, while there is one.
    pub pid: Option<u32>,
    /// How often it was started again.
    pub restarts: u32,
    /// Resident memory in bytes.
    pub memory_bytes: u64,
    /// Processor time lately, in percent of a core.
    pub processor_percent: Option<f32>,
    /// Why it has ended, unless it was asked to.
    pub fault: Option<String>,
    /// What it lacks, or what happens next.
    pub hint: Option<String>,
    /// The last lines that it printed, oldest first.
    pub output: Vec<String>,
    /// Its folder on its host.
    pub folder: String,
}

impl Instance {
    /// How far it has come on its way to being ready, 0 to 1.
    pub fn progress(&self) -> f32 {
        match self.stage {
            SitlStage::Queued | SitlStage::Stopping | SitlStage::Ended => 0.0,
            SitlStage::Process => 0.1,
            SitlStage::Heartbeat => {
                let [received, count] = self.parameters.map(f32::from);
                0.2 + 0.5 * (received / count.max(1.0)).min(1.0)
            }
            SitlStage::Parameters => 0.7,
            SitlStage::Position => 0.85,
            SitlStage::Ready => 1.0,
        }
    }

    /// The same in words.
    pub fn says(&self) -> Text {
        match self.stage {
            SitlStage::Queued => text!("hangar-stage-queued"),
            SitlStage::Process => text!("hangar-stage-process"),
            SitlStage::Heartbeat => match self.parameters {
                [_, 0] => text!("hangar-stage-heartbeat"),
                [received, count] => {
                    text!("hangar-stage-fetching", received = received, count = count)
                }
            },
            SitlStage::Parameters => text!("hangar-stage-parameters"),
            SitlStage::Position => text!("hangar-stage-position"),
            SitlStage::Ready => text!("hangar-stage-ready"),
            SitlStage::Stopping => text!("hangar-stage-stopping"),
            SitlStage::Ended if self.fault.is_some() => text!("hangar-stage-crashed"),
            SitlStage::Ended => text!("hangar-stage-ended"),
        }
    }

    /// Whether it has ended without being asked to.
    pub fn has_crashed(&self) -> bool {
        self.stage == SitlStage::Ended && self.fault.is_some()
    }
}

/// The processes of a session.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Hangar {
    /// They, in the order of their vehicles.
    pub(in crate::app) instances: Vec<Instance>,
    /// How many there are to be.
    pub(in crate::app) expected: usize,
    /// Why they could not be started.
    pub(in crate::app) fault: Option<Text>,
    /// What the process that is looked at has printed.
    pub(in crate::app) printed: Option<(VehicleId, Vec<String>)>,
    /// Whether all have been ready at once: from then on it is flown.
    pub(in crate::app) begun: bool,
}

impl Hangar {
    /// They, in the order of their vehicles.
    pub fn instances(&self) -> &[Instance] {
        &self.instances
    }

    /// How many there are to be.
    pub fn expected(&self) -> usize {
        self.expected
    }

    /// Why they could not be started.
    pub fn fault(&self) -> Option<&Text> {
        self.fault.as_ref()
    }

    /// Whether all have been ready at once: from then on it is flown.
    pub fn has_begun(&self) -> bool {
        self.begun
    }

    /// The one of a vehicle.
    pub fn of(&self, vehicle: VehicleId) -> Option<&Instance> {
        let mut all = self.instances.iter();
        all.find(|instance| instance.vehicle == vehicle)
    }

    /// What a process has printed, oldest first: of the one that is looked at more than its last words.
    pub fn output<'a>(&'a self, instance: &'a Instance) -> &'a [String] {
        match &self.printed {
            Some((vehicle, lines)) if *vehicle == instance.vehicle => lines,
            _ => &instance.output,
        }
    }

    /// How many are ready.
    pub fn ready(&self) -> usize {
        let ready = |instance: &&Instance| instance.stage == SitlStage::Ready;
        self.instances.iter().filter(ready).count()
    }

    /// Whether all that are expected are ready now.
    pub fn is_ready(&self) -> bool {
        self.expected > 0 && self.ready() >= self.expected
    }
}
