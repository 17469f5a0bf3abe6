//! Compares the embedded simulator with a recording of a real `ArduCopter` or `ArduRover`: the same commands at
//! the same times.
//!
//! A recording holds the messages of a vehicle and of a ground station, both with times. [`replay`]
//! sends the ground station's messages to a vehicle of the embedded simulator. [`Observed`] reads
//! the messages of both vehicles in the same way. [`compare`] divides the flight into manoeuvres by
//! the commands, and measures each from a common start: it subtracts the position at the time of
//! the command, so that a difference counts in the manoeuvre that causes it.

mod answers;
mod compare;
mod manoeuvre;
mod observed;
mod replay;
mod series;

#[cfg(test)]
mod tests;

use std::time::Duration;

pub use answers::{Answers, FirstDifference};
pub use compare::{Comparison, Difference, Flight, compare};
pub use manoeuvre::{Aim, Manoeuvre};
pub use observed::Observed;
pub use replay::replay;
pub use series::Series;

use crate::wire::{Decoder, Frame, frame_len};

/// A frame and its time, since the beginning of its recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Timed {
    /// The time since the beginning of the recording.
    pub at: Duration,
    pub frame: Frame,
}

/// A flight of a real vehicle.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// The frames of the vehicle, in order.
    pub heard: Vec<Timed>,
    /// The frames of the ground station, in order.
    pub sent: Vec<Timed>,
}

impl Recording {
    /// A recording from the contents of two tlog files (8 bytes of big-endian microseconds before
    /// each frame) of the same clock. Its time starts at the earliest frame of both files.
    pub fn from_tlogs(heard: &[u8], sent: &[u8]) -> Self {
        let (heard, sent) = (records(heard), records(sent));
        let firsts = [heard.first(), sent.first()];
        let begin = firsts.iter().flatten().map(|first| first.at).min();
        let since = |mut records: Vec<Timed>| {
            for record in &mut records {
                record.at = record.at.saturating_sub(begin.unwrap_or_default());
            }
            records
        };
        Self {
            heard: since(heard),
            sent: since(sent),
        }
    }
}

/// The frames of a tlog, up to the first damaged record.
fn records(mut tlog: &[u8]) -> Vec<Timed> {
    let mut decoder = Decoder::new();
    let mut found = Vec::new();
    while let Some((time, rest)) = tlog.split_first_chunk::<8>() {
        let len = rest.first_chunk().and_then(|head| frame_len(*head));
        let Some((frame, after)) = len.and_then(|len| rest.split_at_checked(len)) else {
            break;
        };
        decoder.push(frame);
        let at = Duration::from_micros(u64::from_be_bytes(*time));
        while let Some(frame) = decoder.next_frame() {
            found.push(Timed { at, frame });
        }
        tlog = after;
    }
    found
}

/// Flies a recording again in the embedded simulator, and compares the two flights.
pub fn fly(recording: &Recording) -> Comparison {
    let real = Observed::new(&recording.heard);
    let simulated = Observed::new(&replay(recording, &real));
    let manoeuvres = manoeuvre::cut(&recording.sent, &real);
    compare(&manoeuvres, &real, &simulated)
}
