//! Results that outlive the process.
