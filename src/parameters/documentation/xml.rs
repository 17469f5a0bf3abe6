//! ArduPilot's `apm.pdef.xml`: an element `param` for each parameter.

use std::ops::Range;

use quick_xml::escape::unescape;
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

use super::{
    DocumentedRange, NamedBit, NamedValue, ParameterDocument, ReadDocuments, bit_number, plain,
};
use crate::diagnostic::Diagnostic;
use crate::text;
use crate::text::Text;

/// The element of a parameter.
const PARAMETER: &[u8] = b"param";

/// A parameter that is being read.
#[derive(Default)]
struct OpenParameter {
    name: String,
    document: ParameterDocument,
    inner: Option<InnerElement>,
}

/// An element with text inside a parameter.
struct InnerElement {
    kind: InnerKind,
    text: String,
    span: Range<usize>,
}

enum InnerKind {
    /// A `field` of this name.
    Field(String),
    /// A `value` with this code.
    Value(String),
    /// A `bit` with this code.
    Bit(String),
}

pub(super) fn read(source: &str) -> ReadDocuments {
    let mut reading = XmlReading::default();
    let mut reader = Reader::from_str(source);
    loop {
        let start = reader.buffer_position() as usize;
        match reader.read_event() {
            Ok(Event::Eof) => break,
            Ok(event) => reading.take(&event, start..reader.buffer_position() as usize),
            Err(error) => {
                let at = (reader.error_position() as usize).min(source.len());
                let said = text!("documentation-xml", fault = error.to_string());
                reading.fault(at..at, said);
                return reading.found;
            }
        }
    }
    if reading.depth > 0 {
        reading.fault(source.len()..source.len(), text!("documentation-cut-off"));
    } else if reading.found.documents.is_empty() {
        reading.fault(0..0, text!("documentation-nothing"));
    }
    reading.found
}

/// The reading of a file.
#[derive(Default)]
struct XmlReading {
    found: ReadDocuments,
    open: Option<OpenParameter>,
    /// The number of open elements.
    depth: usize,
}

impl XmlReading {
    fn fault(&mut self, span: Range<usize>, message: Text) {
        self.found.faults.push(Diagnostic::new(span, message));
    }

    fn take(&mut self, event: &Event<'_>, span: Range<usize>) {
        match event {
            Event::Start(_) => self.depth += 1,
            Event::End(_) => self.depth = self.depth.saturating_sub(1),
            _ => {}
        }
        match event {
            Event::Start(tag) if tag.name().as_ref() == PARAMETER => {
                self.open = Some(OpenParameter::of(tag));
            }
            Event::Empty(tag) if tag.name().as_ref() == PARAMETER => {
                self.add(OpenParameter::of(tag));
            }
            Event::End(tag) if tag.name().as_ref() == PARAMETER => {
                if let Some(parameter) = self.open.take() {
                    self.add(parameter);
                }
            }
            _ => {
                if let Some(parameter) = &mut self.open {
                    self.found.faults.extend(parameter.take(event, span).err());
                }
            }
        }
    }

    fn add(&mut self, parameter: OpenParameter) {
        let OpenParameter { name, document, .. } = parameter;
        self.found.documents.add(&name, document);
    }
}

impl OpenParameter {
    fn of(tag: &BytesStart<'_>) -> Self {
        let name = attribute(tag, "name");
        // The vehicle's own parameters are written with its name: `ArduCopter:RTL_ALT`.
        let own = name.rsplit(':').next().unwrap_or_default();
        Self {
            name: own.to_owned(),
            document: ParameterDocument {
                title: plain(&attribute(tag, "humanName")),
                description: plain(&attribute(tag, "documentation")),
                ..ParameterDocument::default()
            },
            inner: None,
        }
    }

    /// Takes an event between the parameter's tags.
    fn take(&mut self, event: &Event<'_>, span: Range<usize>) -> Result<(), Diagnostic> {
        match event {
            Event::Start(tag) => {
                let kind = match tag.name().as_ref() {
                    b"field" => InnerKind::Field(attribute(tag, "name")),
                    b"value" => InnerKind::Value(attribute(tag, "code")),
                    b"bit" => InnerKind::Bit(attribute(tag, "code")),
                    _ => return Ok(()),
                };
                self.inner = Some(InnerElement {
                    kind,
                    text: String::new(),
                    span: span.end..span.end,
                });
            }
            Event::Text(piece) => self.add(piece, span.end),
            Event::CData(piece) => self.add(piece, span.end),
            // References are resolved together with the text around them.
            Event::GeneralRef(name) => {
                self.add(b"&", span.end);
                self.add(name, span.end);
                self.add(b";", span.end);
            }
            Event::End(_) => {
                if let Some(inner) = self.inner.take() {
                    return self.close(&inner);
                }
            }
            Event::Empty(_)
            | Event::Comment(_)
            | Event::Decl(_)
            | Event::PI(_)
            | Event::DocType(_)
            | Event::Eof => {}
        }
        Ok(())
    }

    fn add(&mut self, piece: &[u8], end: usize) {
        if let Some(inner) = &mut self.inner {
            inner.text.push_str(&String::from_utf8_lossy(piece));
            inner.span.end = end;
        }
    }

    fn close(&mut self, inner: &InnerElement) -> Result<(), Diagnostic> {
        let unescaped = unescape(&inner.text).unwrap_or_default();
        let text = plain(&unescaped);
        let document = &mut self.document;
        let fault = |message: Text| Err(Diagnostic::new(inner.span.clone(), message));
        match &inner.kind {
            InnerKind::Field(name) => match name.as_str() {
                "Units" => document.unit = text,
                "RebootRequired" => document.needs_reboot = text.eq_ignore_ascii_case("true"),
                "Increment" => match number(&text) {
                    Some(step) => document.increment = Some(step),
                    None => return fault(text!("parameters-no-number", value = text)),
                },
                "Range" => match range(&text) {
                    Some(range) => document.range = Some(range),
                    None => return fault(text!("documentation-no-range", written = text)),
                },
                "Bitmask" => document.bits = bits(&text),
                _ => {}
            },
            InnerKind::Value(code) => match number(code) {
                Some(value) => document.values.push(NamedValue { value, name: text }),
                None => return fault(text!("parameters-no-number", value = code)),
            },
            InnerKind::Bit(code) => match bit_number(code) {
                Some(bit) => document.bits.push(NamedBit { bit, name: text }),
                None => return fault(text!("documentation-no-bit", written = code)),
            },
        }
        Ok(())
    }
}

fn attribute(tag: &BytesStart<'_>, name: &str) -> String {
    let found = tag.try_get_attribute(name).ok().flatten();
    let value = found.and_then(|it| {
        it.normalized_value(XmlVersion::Implicit1_0)
            .ok()
            .map(String::from)
    });
    value.unwrap_or_default()
}

fn number(written: &str) -> Option<f64> {
    written
        .trim()
        .parse()
        .ok()
        .filter(|value: &f64| value.is_finite())
}

fn range(written: &str) -> Option<DocumentedRange> {
    let (least, most) = written.split_once(char::is_whitespace)?;
    DocumentedRange::new(number(least)?, number(most)?)
}

/// The bits of `0:Roll,1:Pitch`.
fn bits(written: &str) -> Vec<NamedBit> {
    let parts = written.split(',').filter_map(|part| part.split_once(':'));
    let named = parts.filter_map(|(bit, name)| {
        let (bit, name) = (bit_number(bit)?, name.trim().to_owned());
        Some(NamedBit { bit, name })
    });
    named.collect()
}
