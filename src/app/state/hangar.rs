//! The processes that simulate the vehicles.

pub use crate::sitl::SitlStage;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// A process and the vehicle that it simulates.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    pub vehicle: VehicleId,
    /// The hangar service that runs the process; `None` if this program runs it.
    pub host: Option<String>,
    /// The stage of the process's start.
    pub stage: SitlStage,
    /// The number of parameters received, and the total; 0 while unknown.
    pub parameters: [u16; 2],
    /// The process id, while it runs.
    pub pid: Option<u32>,
    /// The number of restarts.
    pub restarts: u32,
    /// Resident memory in bytes.
    pub memory_bytes: u64,
    /// Recent processor use, in percent of a core.
    pub processor_percent: Option<f32>,
    /// Why the process ended; `None` if it was stopped on request.
    pub fault: Option<String>,
    /// The condition that is not met yet, or the next step.
    pub hint: Option<String>,
    /// The last lines that the process printed, oldest first.
    pub output: Vec<String>,
    /// The process's folder on its host.
    pub folder: String,
}

impl Instance {
    /// The progress of the process's start, from 0 to 1.
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

    /// The stage as text.
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

    /// Whether the process has ended without a request.
    pub fn has_crashed(&self) -> bool {
        self.stage == SitlStage::Ended && self.fault.is_some()
    }
}

/// The processes of a session.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Hangar {
    /// The processes, in the order of their vehicles.
    pub(in crate::app) instances: Vec<Instance>,
    /// The expected number of processes.
    pub(in crate::app) expected: usize,
    /// Why the processes could not be started.
    pub(in crate::app) fault: Option<Text>,
    /// The output of the process shown on the screen, oldest line first.
    pub(in crate::app) printed: Option<(VehicleId, Vec<String>)>,
    /// Whether the flight has begun, which it does once all processes are ready at the same time.
    pub(in crate::app) begun: bool,
}

impl Hangar {
    /// The processes, in the order of their vehicles.
    pub fn instances(&self) -> &[Instance] {
        &self.instances
    }

    /// The expected number of processes.
    pub fn expected(&self) -> usize {
        self.expected
    }

    /// Why the processes could not be started.
    pub fn fault(&self) -> Option<&Text> {
        self.fault.as_ref()
    }

    /// Whether the flight has begun, which it does once all processes are ready at the same time.
    pub fn has_begun(&self) -> bool {
        self.begun
    }

    /// The process of a vehicle.
    pub fn of(&self, vehicle: VehicleId) -> Option<&Instance> {
        let mut all = self.instances.iter();
        all.find(|instance| instance.vehicle == vehicle)
    }

    /// A process's output, oldest line first. For the process on the screen, it is longer than
    /// [`Instance::output`].
    pub fn output<'a>(&'a self, instance: &'a Instance) -> &'a [String] {
        match &self.printed {
            Some((vehicle, lines)) if *vehicle == instance.vehicle => lines,
            _ => &instance.output,
        }
    }

    /// The number of ready processes.
    pub fn ready(&self) -> usize {
        let ready = |instance: &&Instance| instance.stage == SitlStage::Ready;
        self.instances.iter().filter(ready).count()
    }

    /// Whether all expected processes are ready now.
    pub fn is_ready(&self) -> bool {
        self.expected > 0 && self.ready() >= self.expected
    }
}
