//! The channels of a vehicle's transmitter that this program holds.

/// Channels that are overridden; the others are the transmitter's.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct HeldChannels([Option<u16>; HeldChannels::COUNT]);

impl HeldChannels {
    /// The number of channels that can be held.
    pub const COUNT: usize = 16;

    /// Holds a channel, counted from 0, at a pulse width in microseconds. Returns whether there is such a channel.
    pub fn hold(&mut self, channel: usize, pulse_us: u16) -> bool {
        let slot = self.0.get_mut(channel);
        slot.map(|slot| *slot = Some(pulse_us)).is_some()
    }

    /// The pulse width at which a channel, counted from 0, is held; `None` if it is not.
    pub fn pulse_us(&self, channel: usize) -> Option<u16> {
        self.0.get(channel).copied().flatten()
    }

    /// Whether no channel is held.
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(Option::is_none)
    }

    /// The held channels, counted from 1, with their pulse widths: `1: 1500, 3: 1650`.
    pub fn text(&self) -> String {
        let held = self.0.iter().enumerate();
        let parts = held.filter_map(|(at, pulse_us)| Some(format!("{}: {}", at + 1, (*pulse_us)?)));
        parts.collect::<Vec<_>>().join(", ")
    }
}
