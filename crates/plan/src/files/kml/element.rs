//! The elements of an XML document, with their places in the text.

use std::ops::Range;

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use crate::fault::{Fault, FaultKind, Syntax};

/// The maximum nesting depth: deeper than any KML file uses.
const DEEPEST: usize = 100;

#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Element {
    /// The name without its namespace prefix.
    pub(super) name: String,
    /// The attribute `name`, if there is one.
    pub(super) label: Option<String>,
    /// The place of the opening tag.
    pub(super) span: Range<usize>,
    pub(super) children: Vec<Element>,
    /// The text directly inside the element.
    pub(super) text: String,
    /// Where the text begins.
    pub(super) text_at: usize,
}

impl Element {
    pub(super) fn child(&self, name: &str) -> Option<&Self> {
        self.children.iter().find(|child| child.name == name)
    }

    /// The place of the text without surrounding white space.
    pub(super) fn text_span(&self) -> Range<usize> {
        let gap = self.text.len() - self.text.trim_start().len();
        let start = self.text_at + gap;
        start..start + self.text.trim().len()
    }

    /// Collects all elements with a name, at any level, except those inside another element of that
    /// name.
    pub(super) fn find_all<'a>(&'a self, name: &str, into: &mut Vec<&'a Self>) {
        for child in &self.children {
            if child.name == name {
                into.push(child);
            } else {
                child.find_all(name, into);
            }
        }
    }
}

/// The document as an unnamed root element.
pub(super) fn parse(text: &str) -> Result<Element, Fault> {
    let mut reader = Reader::from_str(text);
    let mut open = vec![Element::default()];
    loop {
        let start = reader.buffer_position() as usize;
        let event = reader.read_event().map_err(|error| {
            let at = (reader.error_position() as usize).min(text.len());
            Fault::new(at..at, FaultKind::Xml(error.to_string()))
        })?;
        let span = start..reader.buffer_position() as usize;
        match event {
            Event::Start(tag) => {
                if open.len() > DEEPEST {
                    return Err(Fault::new(span, FaultKind::Syntax(Syntax::TooDeep)));
                }
                open.push(element(&tag, span));
            }
            Event::Empty(tag) => add(&mut open, element(&tag, span)),
            Event::End(_) => {
                if let Some(done) = open.pop() {
                    add(&mut open, done);
                }
            }
            Event::Text(piece) => add_text(&mut open, &piece, start),
            Event::CData(piece) => add_text(&mut open, &piece, start + "<![CDATA[".len()),
            Event::Eof => break,
            Event::Comment(_)
            | Event::Decl(_)
            | Event::PI(_)
            | Event::DocType(_)
            | Event::GeneralRef(_) => {}
        }
    }
    match (open.pop(), open.is_empty()) {
        (Some(root), true) => Ok(root),
        (unclosed, _) => {
            let span = unclosed.map_or(0..0, |element| element.span);
            Err(Fault::new(span, FaultKind::Syntax(Syntax::End)))
        }
    }
}

fn element(tag: &BytesStart<'_>, span: Range<usize>) -> Element {
    let words = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let label = tag.try_get_attribute("name").ok().flatten();
    Element {
        name: words(tag.local_name().as_ref()),
        label: label.map(|label| words(&label.value)),
        span,
        ..Element::default()
    }
}

fn add(open: &mut [Element], element: Element) {
    if let Some(parent) = open.last_mut() {
        parent.children.push(element);
    }
}

fn add_text(open: &mut [Element], piece: &[u8], at: usize) {
    if let Some(parent) = open.last_mut() {
        if parent.text.is_empty() {
            parent.text_at = at;
        }
        parent.text.push_str(&String::from_utf8_lossy(piece));
    }
}
