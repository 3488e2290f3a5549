//! Memory of what nobody keeps, for what comes next.

/// Something large that is made for every path, of which few are kept.
pub trait Reuse: Sized {
    /// Gives its memory to the next of its kind that is made on this thread.
    fn reuse(self);

    /// Gives back the memory that it has too much.
    fn shrink_to_fit(&mut self);

    /// It with no more memory than it needs, if it is to be kept.
    fn kept_if(mut self, is_kept: bool) -> Option<Self> {
        if is_kept {
            self.shrink_to_fit();
            Some(self)
        } else {
            self.reuse();
            None
        }
    }
}
