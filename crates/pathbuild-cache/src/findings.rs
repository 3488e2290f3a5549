//! Diagnostics as bytes. Messages are kept by their keys; names of arguments and words, which are statics in the program, come back as one
//! leaked copy each: there are a few dozen.

use std::collections::{HashMap, HashSet};
use std::sync::{LazyLock, Mutex, PoisonError};

use pathbuild_diagnostic::{
    Diagnostic, ElementId, EntityKind, Handle, Message, Note, Number, Place, Point, Severity, TextFault,
    TraceStep, Value, Word, messages,
};

use crate::codec::{Corrupt, Decoder, Encoder};

/// Adds a diagnostic.
pub fn encode_diagnostic(encoder: &mut Encoder, diagnostic: &Diagnostic) {
    encoder.text(diagnostic.message.key);
    encoder.u8(u8::from(diagnostic.is_error()));
    arguments(encoder, &diagnostic.arguments);
    encoder.list(diagnostic.notes.iter(), encode_note);
    encoder.option(diagnostic.file.as_ref(), |encoder, file| encoder.text(file.as_str()));
    encoder.option(diagnostic.path.as_ref(), |encoder, path| encoder.text(path));
    place(encoder, &diagnostic.place);
    encoder.option(diagnostic.text.as_ref(), |encoder, fault| {
        encoder.text(&fault.text);
        encoder.u32(fault.start);
        encoder.u32(fault.end);
    });
    encoder.list(diagnostic.trace.iter(), |encoder, step| {
        encoder.text(step.file.as_str());
        encoder.text(&step.path);
        point(encoder, step.point);
    });
}

/// Reads what [`encode_diagnostic`] wrote.
///
/// # Errors
/// When the bytes are something else, or of a message that this program does not know.
pub fn decode_diagnostic(decoder: &mut Decoder<'_>) -> Result<Diagnostic, Corrupt> {
    let mut diagnostic = Diagnostic::new(message(decoder)?);
    diagnostic.severity = if decoder.u8()? == 0 { Severity::Warning } else { Severity::Error };
    diagnostic.arguments = decoded_arguments(decoder)?;
    diagnostic.notes = decoder.list(decode_note)?;
    diagnostic.file = decoder.option(|decoder| Ok(decoder.text()?.into()))?;
    diagnostic.path = decoder.option(|decoder| Ok(decoder.text()?.into()))?;
    diagnostic.place = decoded_place(decoder)?;
    diagnostic.text = decoder.option(|decoder| {
        Ok(TextFault { text: decoder.text()?.into(), start: decoder.u32()?, end: decoder.u32()? })
    })?;
    diagnostic.trace = decoder.list(|decoder| {
        Ok(TraceStep {
            file: decoder.text()?.into(),
            path: decoder.text()?.into(),
            point: decoded_point(decoder)?,
        })
    })?;
    Ok(diagnostic)
}

/// Adds a note.
pub fn encode_note(encoder: &mut Encoder, note: &Note) {
    encoder.text(note.message.key);
    arguments(encoder, &note.arguments);
}

/// Reads what [`encode_note`] wrote.
///
/// # Errors
/// As [`decode_diagnostic`].
pub fn decode_note(decoder: &mut Decoder<'_>) -> Result<Note, Corrupt> {
    Ok(Note { message: message(decoder)?, arguments: decoded_arguments(decoder)? })
}

fn message(decoder: &mut Decoder<'_>) -> Result<&'static Message, Corrupt> {
    static BY_KEY: LazyLock<HashMap<&str, &Message>> =
        LazyLock::new(|| messages::all().map(|message| (message.key, message)).collect());
    BY_KEY.get(decoder.text()?).copied().ok_or(Corrupt)
}

fn arguments(encoder: &mut Encoder, arguments: &[(&'static str, Value)]) {
    encoder.list(arguments.iter(), |encoder, (name, value)| {
        encoder.text(name);
        match value {
            Value::Text(text) => {
                encoder.u8(0);
                encoder.text(text);
            }
            Value::Number(Number(number)) => {
                encoder.u8(1);
                encoder.u64(number.to_bits());
            }
            Value::Count(count) => {
                encoder.u8(2);
                encoder.u64(*count);
            }
            Value::Point(at) => {
                encoder.u8(3);
                point(encoder, *at);
            }
            Value::List(items) => {
                encoder.u8(4);
                encoder.list(items.iter(), |encoder, item| encoder.text(item));
            }
            Value::Word(word) => {
                encoder.u8(5);
                encoder.text(word.en);
                encoder.text(word.de);
            }
        }
    });
}

fn decoded_arguments(decoder: &mut Decoder<'_>) -> Result<Vec<(&'static str, Value)>, Corrupt> {
    decoder.list(|decoder| {
        let name = kept(decoder.text()?);
        let value = match decoder.u8()? {
            0 => Value::Text(decoder.text()?.into()),
            1 => Value::Number(Number(f64::from_bits(decoder.u64()?))),
            2 => Value::Count(decoder.u64()?),
            3 => Value::Point(decoded_point(decoder)?),
            4 => Value::List(decoder.list(|decoder| Ok(decoder.text()?.into()))?.into()),
            5 => Value::Word(word(kept(decoder.text()?), kept(decoder.text()?))),
            _ => return Err(Corrupt),
        };
        Ok((name, value))
    })
}

fn place(encoder: &mut Encoder, place: &Place) {
    encoder.option(place.line, Encoder::u32);
    encoder.option(place.column, Encoder::u32);
    encoder.option(place.element, |encoder, ElementId(element)| encoder.u32(element));
    encoder.option(place.handle, |encoder, Handle(handle)| encoder.u64(handle));
    let number = |kind: EntityKind| KINDS.iter().position(|known| *known == kind).unwrap_or(KINDS.len() - 1);
    encoder.option(place.entity, |encoder, kind| encoder.count(number(kind)));
    encoder.option(place.layer.as_ref(), |encoder, layer| encoder.text(layer));
    encoder.option(place.point, point);
}

fn decoded_place(decoder: &mut Decoder<'_>) -> Result<Place, Corrupt> {
    Ok(Place {
        line: decoder.option(Decoder::u32)?,
        column: decoder.option(Decoder::u32)?,
        element: decoder.option(|decoder| decoder.u32().map(ElementId))?,
        handle: decoder.option(|decoder| decoder.u64().map(Handle))?,
        entity: decoder.option(|decoder| KINDS.get(decoder.u32()? as usize).copied().ok_or(Corrupt))?,
        layer: decoder.option(|decoder| Ok(decoder.text()?.into()))?,
        point: decoder.option(decoded_point)?,
    })
}

const KINDS: [EntityKind; 11] = [
    EntityKind::Line,
    EntityKind::Arc,
    EntityKind::Circle,
    EntityKind::Text,
    EntityKind::MText,
    EntityKind::LwPolyline,
    EntityKind::Polyline,
    EntityKind::Ellipse,
    EntityKind::Spline,
    EntityKind::Insert,
    EntityKind::Other,
];

fn point(encoder: &mut Encoder, Point { x: Number(x), y: Number(y) }: Point) {
    encoder.u64(x.to_bits());
    encoder.u64(y.to_bits());
}

fn decoded_point(decoder: &mut Decoder<'_>) -> Result<Point, Corrupt> {
    Ok(Point::new(f64::from_bits(decoder.u64()?), f64::from_bits(decoder.u64()?)))
}

/// One copy of a text for the rest of the run.
fn kept(text: &str) -> &'static str {
    static KEPT: LazyLock<Mutex<HashSet<&'static str>>> = LazyLock::new(Mutex::default);
    let mut all = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = all.get(text) {
        return known;
    }
    let leaked: &'static str = Box::leak(text.to_owned().into_boxed_str());
    all.insert(leaked);
    leaked
}

/// One copy of a word for the rest of the run.
fn word(en: &'static str, de: &'static str) -> &'static Word {
    static KEPT: LazyLock<Mutex<HashMap<(&'static str, &'static str), &'static Word>>> =
        LazyLock::new(Mutex::default);
    let mut all = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    all.entry((en, de)).or_insert_with(|| Box::leak(Box::new(Word { en, de })))
}
