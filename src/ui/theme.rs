//! Themes: the styles of the console's roles. A widget uses a role ("warning"), never a colour. A
//! theme file gives roles a style and may inherit the rest from another theme. A theme that
//! inherits nothing must define every role that has no stand-in.

use std::collections::BTreeMap;

use ratatui::style::{Color, Modifier, Style};

use crate::config::DEFAULT_THEME;

mod colour;
mod file;
mod library;

pub use colour::ColourDepth;
pub use library::{ThemeError, ThemeFile, Themes};

/// The themes that are part of the program: name and file.
const EMBEDDED: [(&str, &str); 4] = [
    ("dark", include_str!("../../themes/dark.toml")),
    ("light", include_str!("../../themes/light.toml")),
    (
        "high-contrast",
        include_str!("../../themes/high-contrast.toml"),
    ),
    ("monochrome", include_str!("../../themes/monochrome.toml")),
];

/// The meaning of a part of the screen, which determines its style.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// Ordinary text, and the background of everything.
    Text,
    /// Labels, units and other secondary text.
    Muted,
    /// Names of panes and columns.
    Title,
    /// The rules between panes and around them.
    Border,
    /// An emphasis that is neither good nor bad.
    Accent,
    /// The first line of the screen.
    Header,
    Key,
    /// The line under the cursor.
    Cursor,
    Selected,
    Ok,
    Info,
    Warning,
    Danger,
    /// A faulty word in an input.
    Error,
    /// An armed vehicle: the most conspicuous state.
    Armed,
    /// A vehicle that can be armed.
    Ready,
    /// An alert that has not been acknowledged.
    Alert,
    /// Fences: where vehicles may fly.
    Fence,
    /// Unconfirmed readings of the sensors.
    Contact,
    /// A hazard: gas, fire, water, radiation.
    Hazard,
    Locked,
    /// The colours that distinguish drones and teams.
    Drone1,
    Drone2,
    Drone3,
    Drone4,
    Drone5,
    Drone6,
}

impl Role {
    /// Every role with its name in theme files.
    pub const ALL: [(&'static str, Self); 27] = [
        ("text", Self::Text),
        ("muted", Self::Muted),
        ("title", Self::Title),
        ("border", Self::Border),
        ("accent", Self::Accent),
        ("header", Self::Header),
        ("key", Self::Key),
        ("cursor", Self::Cursor),
        ("selected", Self::Selected),
        ("ok", Self::Ok),
        ("info", Self::Info),
        ("warning", Self::Warning),
        ("danger", Self::Danger),
        ("error", Self::Error),
        ("armed", Self::Armed),
        ("ready", Self::Ready),
        ("alert", Self::Alert),
        ("fence", Self::Fence),
        ("contact", Self::Contact),
        ("hazard", Self::Hazard),
        ("locked", Self::Locked),
        ("drone1", Self::Drone1),
        ("drone2", Self::Drone2),
        ("drone3", Self::Drone3),
        ("drone4", Self::Drone4),
        ("drone5", Self::Drone5),
        ("drone6", Self::Drone6),
    ];

    /// The roles for drones and teams, in order.
    pub const DRONES: [Self; 6] = [
        Self::Drone1,
        Self::Drone2,
        Self::Drone3,
        Self::Drone4,
        Self::Drone5,
        Self::Drone6,
    ];

    /// The role that replaces this one in a theme that neither inherits nor defines it. A theme
    /// therefore needs to define only the roles of the program's first version.
    fn stand_in(self) -> Option<Self> {
        match self {
            Self::Armed | Self::Alert => Some(Self::Danger),
            Self::Ready => Some(Self::Ok),
            Self::Fence | Self::Hazard => Some(Self::Warning),
            Self::Contact => Some(Self::Accent),
            Self::Locked => Some(Self::Muted),
            Self::Drone1
            | Self::Drone2
            | Self::Drone3
            | Self::Drone4
            | Self::Drone5
            | Self::Drone6 => Some(Self::Text),
            Self::Text
            | Self::Muted
            | Self::Title
            | Self::Border
            | Self::Accent
            | Self::Header
            | Self::Key
            | Self::Cursor
            | Self::Selected
            | Self::Ok
            | Self::Info
            | Self::Warning
            | Self::Danger
            | Self::Error => None,
        }
    }
}

/// A style for every role.
#[derive(Debug, Clone, PartialEq)]
pub struct Theme {
    name: String,
    styles: BTreeMap<Role, Style>,
}

impl Theme {
    /// The names of the embedded themes.
    pub fn names() -> impl Iterator<Item = &'static str> {
        EMBEDDED.iter().map(|&(name, _)| name)
    }

    pub fn named(name: &str) -> Option<Self> {
        let (name, source) = EMBEDDED.iter().find(|(known, _)| *known == name)?;
        Themes::default().read(name, source).ok()
    }

    /// The theme reduced to a terminal's colours; without colours, the monochrome theme, because a role marked only by
    /// its background would vanish.
    #[must_use]
    pub fn for_colours(&self, depth: ColourDepth) -> Self {
        if depth == ColourDepth::None {
            return Self::named("monochrome").unwrap_or_else(|| self.stripped());
        }
        let mut theme = self.mapped(|colour| depth.map(colour));
        let ground = |theme: &Self, role| theme.style(role).bg;
        for (&role, style) in &mut theme.styles {
            // The cursor's line would be invisible if its background had become that of ordinary text.
            let is_lost = ground(self, role) != ground(self, Role::Text)
                && style.bg.is_some()
                && style.bg == self.style(Role::Text).bg.map(|colour| depth.map(colour));
            if is_lost {
                *style = style.add_modifier(Modifier::REVERSED);
            }
        }
        theme
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    /// The style of a role; the terminal's own if the theme gives none.
    pub fn style(&self, role: Role) -> Style {
        self.styles.get(&role).copied().unwrap_or_default()
    }

    fn stripped(&self) -> Self {
        self.mapped(|_| Color::Reset)
    }

    fn mapped(&self, map: impl Fn(Color) -> Color) -> Self {
        let mut theme = self.clone();
        for style in theme.styles.values_mut() {
            style.fg = style.fg.map(&map);
            style.bg = style.bg.map(&map);
        }
        theme
    }
}

impl Default for Theme {
    fn default() -> Self {
        Self::named(DEFAULT_THEME).unwrap_or_else(|| Self {
            name: "plain".to_owned(),
            styles: BTreeMap::from([(Role::Cursor, Style::new().add_modifier(Modifier::REVERSED))]),
        })
    }
}

#[cfg(test)]
mod tests;
