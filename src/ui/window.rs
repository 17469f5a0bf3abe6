//! The title of the terminal's window.

use super::look::Look;
use crate::app::State;
use crate::text;

/// The session and its state, so that the user can find the window: `sortie - First flight - 1 of 3 armed`.
pub fn window_title(state: &State, look: &Look) -> String {
    let session = state.session();
    let Some(activity) = session.activity() else {
        return "sortie".to_owned();
    };
    let armed = session.armed();
    let stands = if session.is_over() {
        text!("window-over")
    } else if session.is_paused() {
        text!("window-paused")
    } else if session.is_reading() {
        text!("window-reading")
    } else if armed > 0 {
        text!(
            "window-armed",
            armed = armed,
            all = session.vehicles().len()
        )
    } else {
        text!("window-ground")
    };
    format!(
        "sortie - {} - {}",
        look.text(&activity.title()),
        look.text(&stands)
    )
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::app::event::{SessionEvent, Started};
    use crate::app::state::Activity;
    use crate::app::{App, Setup};

    #[test]
    fn the_title_names_what_flies_and_how_it_stands() {
        let look = Look::default();
        let mut app = App::new(Setup::default());
        assert_eq!(window_title(app.state(), &look), "sortie");
        let started = Started {
            activity: Activity::Free,
            mission: None,
            places: BTreeMap::new(),
            areas: Vec::new(),
            processes: None,
            speedup: 1.0,
            is_again: false,
        };
        let _effects = app.update(SessionEvent::Started(Box::new(started)));
        assert_eq!(
            window_title(app.state(), &look),
            "sortie - free flight - on the ground"
        );
        let _effects = app.update(SessionEvent::Paused(true));
        assert_eq!(
            window_title(app.state(), &look),
            "sortie - free flight - paused"
        );
    }
}
