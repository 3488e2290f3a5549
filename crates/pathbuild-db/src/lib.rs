//! The query database: inputs, queries, and the system they read from.
