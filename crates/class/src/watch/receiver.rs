//! The desk's side.

use super::part::{PicturePart, apply};
use super::picture::Picture;

/// What has come of a seat's screen.
#[derive(Debug, Clone, Default)]
pub struct PictureReceiver {
    shown: Option<Picture>,
    /// The picture whose last parts are still to come.
    coming: Option<Picture>,
    number: u32,
    is_lost: bool,
}

impl PictureReceiver {
    /// The newest complete picture.
    pub fn picture(&self) -> Option<&Picture> {
        self.shown.as_ref()
    }

    /// Whether a change came for a picture that is not here, so that a whole one has to be asked for.
    pub fn is_lost(&self) -> bool {
        self.is_lost
    }

    /// Takes in a part. One that does not fit what is here is left out, and so are all others until a whole picture
    /// comes.
    pub fn receive(&mut self, part: &PicturePart) {
        let follows = part.number == self.number.wrapping_add(1) && !self.is_lost;
        self.number = part.number;
        let base = match part.size {
            Some([columns, rows]) => Some(Picture::blank(columns, rows)),
            None if follows => self.coming.take().or_else(|| self.shown.clone()),
            None => None,
        };
        self.coming = base.and_then(|mut picture| {
            apply(part, &mut picture)?;
            Some(picture)
        });
        self.is_lost = self.coming.is_none();
        if !part.more && !self.is_lost {
            self.shown = self.coming.take();
        }
    }
}
