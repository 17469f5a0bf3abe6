//! The lines of the tree: link, system, component, message.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::time::Duration;

use super::{LinkTraffic, Messages, Sort};
use crate::app::keymap::latin_line;
use crate::inspector::{Direction, FrameSource, MessageTally, Rate, TallyKey, name_of};
use crate::wire::SystemId;

/// Systems are closed by default if there are more than this.
const FEW_SYSTEMS: usize = 3;

/// A place in the tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Node {
    /// A link, by its number.
    Link(usize),
    /// A system at the other end of the link, or one of this program's own.
    System(usize, Direction, u32, SystemId),
    /// A component of the system.
    Component(usize, FrameSource),
    /// A message of the component.
    Message(usize, TallyKey),
}

impl Node {
    /// The number of the link.
    pub fn link(self) -> usize {
        match self {
            Self::Link(link)
            | Self::System(link, ..)
            | Self::Component(link, _)
            | Self::Message(link, _) => link,
        }
    }

    /// The depth below the root.
    pub fn depth(self) -> usize {
        match self {
            Self::Link(_) => 0,
            Self::System(..) => 1,
            Self::Component(..) => 2,
            Self::Message(..) => 3,
        }
    }

    pub fn parent(self) -> Option<Self> {
        match self {
            Self::Link(_) => None,
            Self::System(link, ..) => Some(Self::Link(link)),
            Self::Component(link, source) => Some(Self::system_of(link, source)),
            Self::Message(link, key) => Some(Self::Component(link, key.source)),
        }
    }

    /// Whether this node is a descendant of another one.
    pub fn is_below(self, other: Self) -> bool {
        let mut at = self.parent();
        while let Some(parent) = at {
            if parent == other {
                return true;
            }
            at = parent.parent();
        }
        false
    }

    fn system_of(link: usize, source: FrameSource) -> Self {
        Self::System(link, source.direction, source.peer, source.system)
    }
}

/// The messages by system and component.
type Systems = BTreeMap<Node, BTreeMap<Node, Vec<Branch>>>;

/// One line of the tree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    pub node: Node,
    /// The rate of all messages below the branch.
    pub rate: Rate,
    /// The number of messages received.
    pub count: u64,
    /// The time since the last message.
    pub age: Option<Duration>,
    /// The standard deviation of a message's intervals; `None` for other lines.
    pub jitter: Option<Duration>,
    /// A message's longest silence since the last reset; `None` for other lines.
    pub silence: Option<Duration>,
    /// Whether the branch is open; `None` for a message.
    pub is_open: Option<bool>,
}

impl Branch {
    fn new(node: Node) -> Self {
        Self {
            node,
            rate: Rate::default(),
            count: 0,
            age: None,
            jitter: None,
            silence: None,
            is_open: None,
        }
    }

    fn of(node: Node, tally: &MessageTally, now: Duration) -> Self {
        Self {
            rate: tally.rate(now),
            count: tally.count,
            age: Some(now.saturating_sub(tally.last_at)),
            jitter: tally.statistics.jitter(),
            silence: Some(tally.statistics.longest_silence(now)),
            ..Self::new(node)
        }
    }

    fn add(&mut self, part: &Self) {
        self.rate += part.rate;
        self.count += part.count;
        self.age = match (self.age, part.age) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
    }
}

impl Messages {
    /// The lines that are shown, from the top. A filter that finds nothing is read as typed in another keyboard layout.
    pub fn branches(&self) -> Vec<Branch> {
        let lines = self.matching(&self.filter);
        match latin_line(&self.filter) {
            Some(read) if lines.is_empty() => self.matching(&read),
            _ => lines,
        }
    }

    fn matching(&self, filter: &str) -> Vec<Branch> {
        let mut lines = Vec::new();
        for (link, traffic) in self.traffic.iter().enumerate() {
            self.add_link(link, traffic, filter, &mut lines);
        }
        lines
    }

    fn add_link(&self, link: usize, traffic: &LinkTraffic, filter: &str, lines: &mut Vec<Branch>) {
        let systems = systems(link, traffic, filter);
        if systems.is_empty() && !self.filter.is_empty() {
            return;
        }
        let mut total = Branch::new(Node::Link(link));
        let messages = systems.values().flat_map(BTreeMap::values).flatten();
        messages.for_each(|part| total.add(part));
        let are_few = systems.len() <= FEW_SYSTEMS;
        if !self.push(total, true, lines) {
            return;
        }
        for (system, components) in systems {
            let mut sum = Branch::new(system);
            components.values().flatten().for_each(|part| sum.add(part));
            if !self.push(sum, are_few, lines) {
                continue;
            }
            for (component, mut messages) in components {
                let mut sum = Branch::new(component);
                for part in &messages {
                    sum.add(part);
                }
                if self.push(sum, true, lines) {
                    self.order(&mut messages);
                    lines.extend(messages);
                }
            }
        }
    }

    /// Adds a line that can be closed, and returns whether it is open. With a filter, every line is
    /// open.
    fn push(&self, branch: Branch, by_default: bool, lines: &mut Vec<Branch>) -> bool {
        let is_turned = self.turned.contains(&branch.node);
        let is_open = !self.filter.is_empty() || by_default != is_turned;
        lines.push(Branch {
            is_open: Some(is_open),
            ..branch
        });
        is_open
    }

    fn order(&self, messages: &mut [Branch]) {
        let id = |branch: &Branch| match branch.node {
            Node::Message(_, key) => key.message,
            Node::Link(_) | Node::System(..) | Node::Component(..) => 0,
        };
        match self.sort {
            Sort::Number => messages.sort_by_key(id),
            Sort::Name => messages.sort_by_key(|branch| name_of(id(branch))),
            Sort::Rate => messages.sort_by_key(|branch| {
                // Whole hundredths; otherwise two messages of the same rate would keep changing places.
                (Reverse((branch.rate.hz * 100.0).round() as u64), id(branch))
            }),
            Sort::Age => messages.sort_by_key(|branch| (branch.age, id(branch))),
        }
    }
}

fn matches(filter: &str, key: TallyKey) -> bool {
    if filter.is_empty() {
        return true;
    }
    let wanted = filter.to_lowercase();
    name_of(key.message).to_lowercase().contains(&wanted) || key.message.to_string() == filter
}

/// The messages of a link that match the filter, by system and component.
fn systems(link: usize, traffic: &LinkTraffic, filter: &str) -> Systems {
    let mut systems = Systems::new();
    let Some(census) = &traffic.census else {
        return systems;
    };
    for (key, tally) in census.tallies() {
        if !census.is_credible(key, tally) || !matches(filter, key) {
            continue;
        }
        systems
            .entry(Node::system_of(link, key.source))
            .or_default()
            .entry(Node::Component(link, key.source))
            .or_default()
            .push(Branch::of(Node::Message(link, key), tally, traffic.now));
    }
    systems
}
