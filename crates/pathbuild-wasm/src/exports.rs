//! The C interface for the browser. It handles one message at a time: the page requests a buffer ([`room`]), writes the question into it, requests
//! the answer ([`answer`]), and reads the answer in place ([`answered`]).
#![expect(unsafe_code, reason = "an exported function needs a name that is unique in the program")]

use std::cell::RefCell;
use std::panic;
use std::sync::Once;

use crate::Compiler;

thread_local! {
    static COMPILER: RefCell<Compiler> = RefCell::default();
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static RESPONSE: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static PANIC: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

static INITIALIZED: Once = Once::new();

/// Provides a buffer of this size in bytes for a question, and returns its address.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    INITIALIZED.call_once(|| panic::set_hook(Box::new(store_panic_message)));
    REQUEST.with_borrow_mut(|question| {
        *question = vec![0; length];
        question.as_mut_ptr()
    })
}

/// Answers the question in the buffer. Returns the length of the answer in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> usize {
    let question = REQUEST.take();
    let answer = COMPILER.with_borrow_mut(|compiler| compiler.answer(&question));
    RESPONSE.replace(answer);
    RESPONSE.with_borrow(Vec::len)
}

/// Returns the address of the last answer.
#[unsafe(no_mangle)]
pub extern "C" fn answered() -> *const u8 {
    RESPONSE.with_borrow(Vec::as_ptr)
}

/// Returns the length in bytes of the message of the panic that ended a call; 0 if no panic did.
#[unsafe(no_mangle)]
pub extern "C" fn panicked() -> usize {
    PANIC.with_borrow(Vec::len)
}

/// Returns the address of the message of the panic.
#[unsafe(no_mangle)]
pub extern "C" fn panic_text() -> *const u8 {
    PANIC.with_borrow(Vec::as_ptr)
}

/// Stores the message of a panic for the page, which can read memory even after the call has ended.
fn store_panic_message(panic: &panic::PanicHookInfo<'_>) {
    let text = panic.payload_as_str().unwrap_or_default();
    PANIC.replace(text.as_bytes().to_vec());
}
