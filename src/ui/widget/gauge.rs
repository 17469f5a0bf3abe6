//! Gauges: a share in a few cells, in a colour that shows its meaning.

use ratatui::text::Span;

use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::vehicle::{Grade, HomeReach, LinkQuality};

/// The minimum share of messages received on a good link, in percent.
const GOOD_PERCENT: u8 = 90;

/// A share between 0 and 1, for display.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gauge {
    /// The filled share, 0 to 1.
    pub share: f64,
    /// A second share to mark, such as the battery needed to return home.
    pub mark: Option<f64>,
    pub role: Role,
}

impl Gauge {
    /// The gauge in this many cells; anything above zero is visible.
    pub fn spans(&self, cells: usize, look: &Look) -> Vec<Span<'static>> {
        let cell = |share: f64| (share.clamp(0.0, 1.0) * cells as f64).round() as usize;
        let least = usize::from(self.share > 0.0);
        let filled = cell(self.share).max(least).min(cells);
        let mark = self.mark.map(|share| cell(share).clamp(1, cells) - 1);
        let part = |from: usize, to: usize, sign: &str, role: Role| {
            Span::styled(sign.repeat(to - from), look.fill(role))
        };
        let ends = [
            (0, filled, "█", self.role),
            (filled, cells, "·", Role::Muted),
        ];
        let mut spans = Vec::new();
        for (from, to, sign, role) in ends {
            // In the last cell, the mark would hide whether the gauge is full.
            let hides_end = filled == cells && mark == Some(cells - 1);
            match mark.filter(|at| (from..to).contains(at) && !hides_end) {
                Some(at) => spans.extend([
                    part(from, at, sign, role),
                    part(at, at + 1, "┃", Role::Text),
                    part(at + 1, to, sign, role),
                ]),
                None => spans.push(part(from, to, sign, role)),
            }
        }
        spans
    }
}

/// The theme role of a battery charge.
pub fn battery_role(left_percent: u8) -> Role {
    match Grade::of_battery(left_percent) {
        Grade::Good => Role::Ok,
        Grade::Poor => Role::Warning,
        Grade::Bad => Role::Danger,
    }
}

/// The theme role for the quality of a link.
pub fn link_role(link: &LinkQuality) -> Role {
    if link.lost {
        Role::Danger
    } else if link.percent() < GOOD_PERCENT {
        Role::Warning
    } else {
        Role::Ok
    }
}

/// The theme role of the battery needed to return home, compared with the remaining battery.
pub fn reach_role(reach: HomeReach) -> Role {
    match reach {
        HomeReach::Ample => Role::Ok,
        HomeReach::TurnBack => Role::Warning,
        HomeReach::OutOfReach => Role::Danger,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ui::Theme;

    fn drawn(share: f64, mark: Option<f64>) -> String {
        let gauge = Gauge {
            share,
            mark,
            role: Role::Ok,
        };
        let spans = gauge.spans(8, &Look::default());
        spans.iter().map(|span| span.content.as_ref()).collect()
    }

    #[test]
    fn a_gauge_is_filled_by_its_share_and_never_hides_a_rest() {
        assert_eq!(drawn(0.0, None), "········");
        assert_eq!(drawn(0.01, None), "█·······");
        assert_eq!(drawn(0.5, None), "████····");
        assert_eq!(drawn(1.7, None), "████████");
    }

    #[test]
    fn what_is_filled_is_seen_in_every_theme() {
        use ratatui::style::Modifier;
        for name in Theme::names() {
            let theme = Theme::named(name).expect("it is one of ours");
            let look = Look {
                theme,
                ..Look::default()
            };
            let gauge = Gauge {
                share: 0.5,
                mark: None,
                role: Role::Danger,
            };
            for span in gauge.spans(8, &look) {
                assert!(
                    !span.style.add_modifier.contains(Modifier::REVERSED),
                    "{name}"
                );
            }
        }
    }

    #[test]
    fn a_mark_stands_where_its_share_ends_and_takes_no_room() {
        assert_eq!(drawn(1.0, Some(0.5)), "███┃████");
        assert_eq!(drawn(0.25, Some(0.5)), "██·┃····");
        assert_eq!(drawn(0.5, Some(0.0)), "┃███····");
    }

    #[test]
    fn a_full_gauge_differs_from_one_just_below_its_mark() {
        let cells = |share| {
            let gauge = Gauge {
                share,
                mark: Some(0.95),
                role: Role::Ok,
            };
            let spans = gauge.spans(10, &Look::default());
            spans
                .iter()
                .map(|it| it.content.as_ref())
                .collect::<String>()
        };
        assert_eq!(cells(0.93), "█████████┃");
        assert_eq!(cells(1.0), "██████████");
    }

    #[test]
    fn thresholds_change_the_colour() {
        let roles = [100, 26, 25, 11, 10, 0].map(battery_role);
        let (ok, warning, danger) = (Role::Ok, Role::Warning, Role::Danger);
        assert_eq!(roles, [ok, ok, warning, warning, danger, danger]);
    }
}
