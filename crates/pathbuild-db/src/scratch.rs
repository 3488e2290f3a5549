//! Scratch buffers for reading drawings, reused from one drawing to the next.

use std::fmt;
use std::sync::{Mutex, PoisonError};

use pathbuild_dxf::Drawing;

/// Buffers for one drawing.
#[derive(Default)]
pub(crate) struct Scratch {
    /// The bytes of the file.
    pub(crate) bytes: Vec<u8>,
    /// The parsed drawing.
    pub(crate) drawing: Drawing,
}

/// Scratch buffers that are not in use.
#[derive(Default)]
pub struct ScratchPool(Mutex<Vec<Scratch>>);

/// Largest buffer in bytes that is kept. Few drawings need more.
const MOST_BYTES: usize = 1 << 20;
const MOST_ENTITIES: usize = 1 << 12;

impl ScratchPool {
    /// Calls `work` with a scratch buffer, which holds the content of the previous drawing.
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
