//! The drawing language: path names, parameters, variables, the walk, chains.
