//! The groups of one entity, kept as bytes until the entity turns out to be wanted.
//!
//! Each code that the reader needs has a slot, by its [`Role`]; groups that an entity repeats (points of a polyline, chunks of a text) are also
//! kept in order. Storing them allocates no memory per entity.

use pathbuild_diagnostic::Handle;

use crate::Point3;
use crate::groups::{Group, Groups, Role};
use crate::number::{NotANumber, real, whole_number};
use crate::pairs::{Pair, Stop, without_cr};

#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Value<'a> {
    /// The bytes, not trimmed.
    pub(crate) bytes: &'a [u8],
    /// The line of the group code.
    pub(crate) line: u32,
    /// The number of the entity that has this value. If that is an earlier entity, the slot is empty.
    entity: u32,
}

/// A group that is missing or faulty.
#[derive(Clone, Copy, Debug)]
pub(crate) enum BadGroup<'a> {
    /// A required group is missing.
    Missing {
        /// The code of the group.
        code: i32,
    },
    /// The value of a group is not a number.
    Number {
        /// The code of the group.
        code: i32,
        value: Value<'a>,
        reason: NotANumber,
    },
    /// The value of a group is not a positive length.
    NotPositive {
        /// The code of the group.
        code: i32,
        value: Value<'a>,
    },
    /// A polyline does not have as many vertices as it states.
    VertexCount { value: Value<'a>, found: usize },
}

/// The groups of an entity.
pub(crate) struct Fields<'a> {
    /// The line of the entity's first pair, which has code 0.
    pub(crate) line: u32,
    /// Number of the current entity; slots with another number are empty.
    entity: u32,
    slots: [Value<'a>; SLOTS],
    /// Groups with codes that this kind of entity repeats, in order.
    pub(crate) repeated: Vec<Pair<'a>>,
    /// Largest number of repeated groups to keep.
    most_repeated: usize,
}

/// The decision of [`Fields::fill`] about the groups of an entity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FillDecision {
    Keep,
    Skip,
    /// The groups of the entity are skipped, but its text is kept.
    Note,
}

/// Number of slots: one per role that keeps its value, one for all others, and one for the extension dictionary. The slot of code 101 holds the
/// number of columns of an embedded object.
const SLOTS: usize = 89;

const TEXT: Role = Role::of(1);

const DICTIONARY_SLOT: usize = SLOTS - 1;

/// Code of the number of columns in the embedded object of an MTEXT.
const COLUMN_COUNT: Role = Role::of(72);

impl<'a> Value<'a> {
    pub(crate) fn new(bytes: &'a [u8], line: u32) -> Self {
        Self { bytes, line, entity: 0 }
    }
}

impl<'a> Fields<'a> {
    /// Creates fields without an entity, which keep at most `most_repeated` repeated groups.
    pub(crate) fn new(most_repeated: usize) -> Self {
        Self { line: 0, entity: 0, slots: [Value::default(); SLOTS], repeated: Vec::new(), most_repeated }
    }

    /// Reads the entity that begins with code 0 on this line. `repeats` has a bit for each code that the entity repeats, and `want` is called once
    /// the entity's layer is known. Returns the first pair of the next entity, and whether this entity was kept.
    #[inline]
    pub(crate) fn fill(
        &mut self,
        groups: &mut Groups<'a>,
        line: u32,
        repeats: u64,
        mut want: impl FnMut(Value<'a>) -> FillDecision,
    ) -> Result<(Pair<'a>, FillDecision), Stop<'a>> {
        self.line = line;
        self.begin_entity();
        self.repeated.clear();
        loop {
            let group = if repeats == 0 {
                groups.pass_until(|role| !role.is_plain(), |group| self.store(group))
            } else {
                groups.pass_until(|role| !role.is_plain(), |group| self.store_repeated(group, repeats))
            }?;
            if let Some(end) = self.handle_special(&group, groups, &mut want)? {
                return Ok(end);
            }
        }
    }

    #[inline]
    fn store(&mut self, group: &Group<'a>) {
        if let Some(value) = self.slots.get_mut(group.role.slot()) {
            *value = Value { bytes: group.raw, line: group.line(), entity: self.entity };
        }
    }

    /// Stores the value of a group that may be repeated.
    #[inline]
    fn store_repeated(&mut self, group: &Group<'a>, repeats: u64) {
        self.store(group);
        let slot = group.role.slot();
        if slot < 64 && repeats >> slot & 1 != 0 && !self.is_full() {
            self.repeated.push(group.pair());
        }
    }

    /// Handles a group with a special role. If the group ends the entity or skips the rest of it, returns the first pair of the next entity, and
    /// whether this entity is kept.
    #[inline]
    fn handle_special(
        &mut self,
        group: &Group<'a>,
        groups: &mut Groups<'a>,
        want: &mut impl FnMut(Value<'a>) -> FillDecision,
    ) -> Result<Option<(Pair<'a>, FillDecision)>, Stop<'a>> {
        match group.role {
            Role::BEGIN => return Ok(Some((group.pair(), FillDecision::Keep))),
            Role::LAYER => {
                let value = Value { bytes: group.value(), line: group.line(), entity: self.entity };
                match want(value) {
                    FillDecision::Keep => {}
                    FillDecision::Skip => return Ok(Some((groups.next_record_head()?, FillDecision::Skip))),
                    FillDecision::Note => {
                        let is_text = |role| role == TEXT || role == Role::LEADER_TEXT;
                        return Ok(Some((self.store_first(is_text, TEXT, groups)?, FillDecision::Note)));
                    }
                }
            }
            // An embedded object (in the MTEXT of R2018) extends to the end of the entity.
            Role::EMBEDDED => {
                let next = self.store_first(|role| role == COLUMN_COUNT, Role::EMBEDDED, groups)?;
                return Ok(Some((next, FillDecision::Keep)));
            }
            // In a multileader, the lines of the arrow follow the text and have the same code.
            Role::LEADER_TEXT if self.get(1).is_none() => self.store(&group.with_role(TEXT)),
            Role::LEADER_TEXT => {}
            _ if group.raw.trim_ascii().starts_with(b"{") => {
                let is_dictionary = group.raw.trim_ascii() == b"{ACAD_XDICTIONARY";
                let entity = self.entity;
                let end = skip_application_group(groups, |group| {
                    if is_dictionary {
                        self.slots[DICTIONARY_SLOT] =
                            Value { bytes: group.value(), line: group.line(), entity };
                    }
                });
                return Ok(end?.map(|next| (next, FillDecision::Keep)));
            }
            _ => {}
        }
        Ok(None)
    }

    /// Stores the first of the remaining groups of the entity whose role satisfies `is_wanted`, if there is one, as the value of `to`. Returns the
    /// first pair of the next entity.
    fn store_first(
        &mut self,
        is_wanted: impl Fn(Role) -> bool,
        to: Role,
        groups: &mut Groups<'a>,
    ) -> Result<Pair<'a>, Stop<'a>> {
        let group = groups.pass_until(|role| is_wanted(role) || role == Role::BEGIN, |_| {})?;
        if group.role == Role::BEGIN {
            return Ok(group.pair());
        }
        self.store(&group.with_role(to));
        groups.next_record_head()
    }

    /// Whether repeated groups may have been dropped.
    pub(crate) fn is_full(&self) -> bool {
        self.repeated.len() >= self.most_repeated
    }

    /// Empties all slots by moving on to a new entity number.
    fn begin_entity(&mut self) {
        if self.entity == u32::MAX {
            self.slots = [Value::default(); SLOTS];
            self.entity = 0;
        }
        self.entity += 1;
    }

    /// Returns the value of a code, if present. If the code occurs several times, the last value is returned.
    #[inline]
    pub(crate) fn get(&self, code: i32) -> Option<Value<'a>> {
        let value = self.slots.get(Role::of(code).slot()).filter(|value| value.entity == self.entity)?;
        Some(Value { bytes: without_cr(value.bytes), ..*value })
    }

    /// Returns the value of a code as a number; `None` if the group is missing.
    #[inline]
    pub(crate) fn number(&self, code: i32) -> Result<Option<f64>, BadGroup<'a>> {
        let Some(value) = self.get(code) else { return Ok(None) };
        real(value.bytes).map(Some).map_err(|reason| BadGroup::Number { code, value, reason })
    }

    /// Returns the value of a code as a number. The group must be present.
    #[inline]
    pub(crate) fn required(&self, code: i32) -> Result<f64, BadGroup<'a>> {
        self.number(code)?.ok_or(BadGroup::Missing { code })
    }

    /// Returns the value of a code as a length. The group must be present, and the length positive.
    #[inline]
    pub(crate) fn length(&self, code: i32) -> Result<f64, BadGroup<'a>> {
        let length = self.required(code)?;
        if length > 0.0 {
            return Ok(length);
        }
        Err(self.get(code).map_or(BadGroup::Missing { code }, |value| BadGroup::NotPositive { code, value }))
    }

    /// Returns the value of a code as an integer; `None` if the group is missing.
    pub(crate) fn whole_number(&self, code: i32) -> Result<Option<i64>, BadGroup<'a>> {
        let Some(value) = self.get(code) else { return Ok(None) };
        whole_number(value.bytes).map(Some).map_err(|reason| BadGroup::Number { code, value, reason })
    }

    /// Checks the numbers that decide whether the entity is visible (60) and in which space it is (67).
    pub(crate) fn check_visibility(&self) -> Result<(), BadGroup<'a>> {
        [60, 67].into_iter().try_for_each(|code| self.whole_number(code).map(drop))
    }

    /// Returns the point that has this code for its x. `z` may be missing; R10 used the elevation (38) instead.
    #[inline]
    pub(crate) fn point(&self, x: i32) -> Result<Point3, BadGroup<'a>> {
        let z = self.number(x + 20)?.map_or_else(|| self.number(38), |z| Ok(Some(z)))?;
        Ok(Point3 { x: self.required(x)?, y: self.required(x + 10)?, z: z.unwrap_or(0.0) })
    }

    /// Returns the handle, if it is present and hexadecimal.
    #[inline]
    pub(crate) fn handle(&self) -> Option<Handle> {
        handle(self.get(5)?.bytes)
    }

    /// Returns the handle of the entity's extension dictionary, if it has one.
    pub(crate) fn dictionary(&self) -> Option<Handle> {
        let value = self.slots[DICTIONARY_SLOT];
        if value.entity == self.entity { handle(value.bytes) } else { None }
    }
}

/// Parses a handle; `None` if it is not hexadecimal.
pub(crate) fn handle(text: &[u8]) -> Option<Handle> {
    let digits = text.trim_ascii();
    if digits.is_empty() || digits.len() > 16 {
        return None;
    }
    let digit = |digit: &u8| char::from(*digit).to_digit(16).map(u64::from);
    let number = digits.iter().try_fold(0, |number, byte| Some(number << 4 | digit(byte)?));
    number.map(Handle)
}

/// Passes over the groups of an application, from `102/{NAME` to `102/}`. If the entity ends before its group does, returns the first pair of the
/// next entity; otherwise `None`.
fn skip_application_group<'a>(
    groups: &mut Groups<'a>,
    pass: impl FnMut(&Group<'a>),
) -> Result<Option<Pair<'a>>, Stop<'a>> {
    let is_end = |role| matches!(role, Role::BEGIN | Role::APPLICATION);
    let end = groups.pass_until(is_end, pass)?;
    Ok((end.role == Role::BEGIN).then(|| end.pair()))
}
