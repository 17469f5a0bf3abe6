//! Flights of the class that the desk replays.

/// A flight that was handed in, to be replayed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FoundFlights {
    /// The names of the trainee, that of the user and that of the profile, and when the flight began.
    pub trainee: String,
    /// The name of the record.
    pub record: String,
    /// The file with its frames.
    pub frames: String,
    /// Another flight of the mission, to be shown beside it.
    pub beside: Option<BesideFlight>,
}

/// A flight that is shown beside a replay.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BesideFlight {
    /// The names of the trainee, and when the flight began.
    pub trainee: String,
    /// The file with the record of the mission.
    pub run: String,
}
