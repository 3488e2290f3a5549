//! The moves of a path, and the fold that places, joins and merges them into a program.
