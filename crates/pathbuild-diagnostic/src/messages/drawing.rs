//! TBD

messages! {}
