//! The layers of a block, as far as they show while its end is looked for.

use crate::code::Role;
use crate::encoding::is_plain;
use crate::entities::is_end;
use crate::fields::Value;
use crate::groups::{Group, Groups};
use crate::kind::Kind;
use crate::names::is_same;
use crate::pairs::{Pair, Stop};

/// Passes over the records of a block, of which this is the first, and adds the layers that its entities name, each once in a row.
/// Gives back the record that ends it, and whether these are all the layers that anything in it can be on, and all there is to be
/// decoded: so not if something is inserted or written in it, or out of the ordinary.
pub(crate) fn layers_named<'a>(
    groups: &mut Groups<'a>,
    mut head: Pair<'a>,
    layers: &mut Vec<Value<'a>>,
) -> Result<(Pair<'a>, bool), Stop<'a>> {
    let begin = layers.len();
    let mut are_all = true;
    loop {
        let next = match Kind::of(head.value) {
            None if is_end(&head) => return Ok((head, are_all && head.is("ENDBLK"))),
            Some(Kind::Insert | Kind::Text | Kind::MText) => None,
            Some(kind) if are_all && !kind.is_part() => {
                let (next, layer) = layer_named(groups, head.line)?;
                let is_another = |layer: &Value<'_>| {
                    layers[begin..].last().is_none_or(|last| !is_same(last.bytes, layer.bytes))
                };
                are_all = layer.is_some();
                layers.extend(layer.filter(is_another));
                Some(next)
            }
            _ => Some(groups.next_zero()?),
        };
        are_all &= next.is_some();
        head = next.map_or_else(|| groups.next_zero(), Ok)?;
    }
}

/// The layer of an entity that has begun on this line, and the record behind it. No layer if it is named twice, or if there is anything
/// that decides what counts or that has to be decoded.
fn layer_named<'a>(groups: &mut Groups<'a>, line: u32) -> Result<(Pair<'a>, Option<Value<'a>>), Stop<'a>> {
    const UNNAMED: &[u8] = b"0";
    let is_of_interest = |role: Role| !role.is_plain() || role == Role::LINE_TYPE;
    let mut layer = None;
    loop {
        let group = groups.pass_until(is_of_interest, |_| {})?;
        match group.role {
            Role::BEGIN => return Ok((group.pair(), Some(layer.unwrap_or(Value::new(UNNAMED, line))))),
            Role::LAYER if layer.is_none() => layer = Some(value(&group)),
            Role::LINE_TYPE if is_plain(group.raw) => {}
            _ => return Ok((groups.next_zero()?, None)),
        }
    }
}

fn value<'a>(group: &Group<'a>) -> Value<'a> {
    Value::new(group.value(), group.line())
}
