//! Memory for reading drawings, used again for the next one.

use std::fmt;
use std::sync::{Mutex, PoisonError};

use pathbuild_dxf::Drawing;

/// What one drawing after the other is read into.
#[derive(Default)]
pub(crate) struct Scratch {
    /// The bytes of the file.
    pub(crate) bytes: Vec<u8>,
    /// What they say.
    pub(crate) drawing: Drawing,
}

/// Scratch memory that nobody uses at the moment.
#[derive(Default)]
pub struct ScratchPool(Mutex<Vec<Scratch>>);

/// Larger buffers are given back to the system: few drawings need them.
const MOST_BYTES: usize = 1 << 20;
const MOST_ENTITIES: usize = 1 << 12;

impl ScratchPool {
    /// Works with scratch memory. Its content is what the last drawing left.
    pub(crate) fn with<R>(&self, work: impl FnOnce(&mut Scratch) -> R) -> R {
        let mut scratch = self.free().pop().unwrap_or_default();
        let result = work(&mut scratch);
        if scratch.bytes.len() <= MOST_BYTES && scratch.drawing.entities.capacity() <= MOST_ENTITIES {
            self.free().push(scratch);
        }
        result
    }

    fn free(&self) -> std::sync::MutexGuard<'_, Vec<Scratch>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl fmt::Debug for ScratchPool {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ScratchPool").finish_non_exhaustive()
    }
}
