//! What a browser calls. One message at a time: it asks for room ([`room`]), writes the question there, has it answered ([`answer`]), and reads
//! the answer where it lies ([`answered`]).
#![expect(
    unsafe_code,
    reason = "a function that is called from outside has a name that nobody else may have"
)]

use std::cell::RefCell;
use std::panic;
use std::sync::Once;

use crate::Compiler;

thread_local! {
    static COMPILER: RefCell<Compiler> = RefCell::default();
    static QUESTION: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static PANIC: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

static BEGUN: Once = Once::new();

/// Room for a question of so many bytes: where it is.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    BEGUN.call_once(|| panic::set_hook(Box::new(keep)));
    QUESTION.with_borrow_mut(|question| {
        *question = vec![0; length];
        question.as_mut_ptr()
    })
}

/// Answers the question: how many bytes the answer has.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> usize {
    let question = QUESTION.take();
    let answer = COMPILER.with_borrow_mut(|compiler| compiler.answer(&question));
    ANSWER.replace(answer);
    ANSWER.with_borrow(Vec::len)
}

/// Where the answer is.
#[unsafe(no_mangle)]
pub extern "C" fn answered() -> *const u8 {
    ANSWER.with_borrow(Vec::as_ptr)
}

/// How many bytes a panic said, by which the call ended; 0: something else ended it.
#[unsafe(no_mangle)]
pub extern "C" fn panicked() -> usize {
    PANIC.with_borrow(Vec::len)
}

/// Where these are.
#[unsafe(no_mangle)]
pub extern "C" fn panic_text() -> *const u8 {
    PANIC.with_borrow(Vec::as_ptr)
}

/// Keeps what a panic says: it ends the call, but memory can still be read.
fn keep(panic: &panic::PanicHookInfo<'_>) {
    let text = panic.payload_as_str().unwrap_or_default();
    PANIC.replace(text.as_bytes().to_vec());
}
