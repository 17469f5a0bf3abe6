//! Which seats a desk watches.

/// The maximum number of seats that are watched at once.
pub const WATCHED: usize = 4;

/// What a desk watches. Seats are meant by their index.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub enum Watching {
    /// No seat: the page at the desk needs neither screens nor states.
    #[default]
    Nothing,
    /// The screen of a seat, and what is behind it.
    Screen(usize),
    /// What is behind the screens of several seats.
    Tiles(Vec<usize>),
}

/// What a seat is asked to send while it is watched.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct WatchedParts {
    pub screen: bool,
    pub insight: bool,
}

impl WatchedParts {
    pub fn is_any(self) -> bool {
        self.screen || self.insight
    }
}

impl Watching {
    /// The seat whose screen is watched.
    pub fn screen(&self) -> Option<usize> {
        match self {
            Self::Screen(seat) => Some(*seat),
            Self::Nothing | Self::Tiles(_) => None,
        }
    }

    /// All seats that are watched.
    pub fn seats(&self) -> &[usize] {
        match self {
            Self::Nothing => &[],
            Self::Screen(seat) => std::slice::from_ref(seat),
            Self::Tiles(seats) => seats,
        }
    }

    pub(super) fn parts_of(&self, seat: usize) -> WatchedParts {
        WatchedParts {
            screen: self.screen() == Some(seat),
            insight: self.seats().contains(&seat),
        }
    }

    /// Without seats that do not exist, those that are named twice, and those beyond the limit.
    pub(super) fn among(self, seats: usize) -> Self {
        match self {
            Self::Screen(seat) if seat >= seats => Self::Nothing,
            Self::Tiles(tiles) => {
                let mut kept: Vec<usize> = Vec::new();
                for tile in tiles {
                    if tile < seats && !kept.contains(&tile) && kept.len() < WATCHED {
                        kept.push(tile);
                    }
                }
                Self::Tiles(kept)
            }
            other => other,
        }
    }
}
