//! How the page calls: it writes the question into memory, asks, and reads the answer.
//!
//! The functions are exported by their names, which the lint counts as unsafe; nothing else here is.
#![allow(unsafe_code)]

use std::cell::RefCell;

thread_local! {
    static QUESTION: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

#[cfg(feature = "studio")]
unsafe extern "C" {
    /// The page is told the share of the work that is done.
    safe fn progress(share: f64);
}

/// Where a question of so many bytes is to be written; null if there is no room.
#[unsafe(no_mangle)]
pub extern "C" fn question(length: usize) -> *mut u8 {
    QUESTION.with_borrow_mut(|bytes| {
        bytes.clear();
        if bytes.try_reserve_exact(length).is_err() {
            return std::ptr::null_mut();
        }
        bytes.resize(length, 0);
        bytes.as_mut_ptr()
    })
}

/// Answers the question with what is shown of a scene; the answer has so many bytes.
#[cfg(not(feature = "studio"))]
#[unsafe(no_mangle)]
pub extern "C" fn view() -> usize {
    let numbers = QUESTION.with_borrow(|question| crate::view(question));
    told(numbers.into_iter().flat_map(f64::to_le_bytes).collect())
}

/// Has the scene in the question a curve?
#[cfg(not(feature = "studio"))]
#[unsafe(no_mangle)]
pub extern "C" fn allowed() -> bool {
    QUESTION.with_borrow(|question| crate::allowed(question))
}

/// Answers any other question, which stands behind so many bytes of its payload.
#[cfg(feature = "studio")]
#[unsafe(no_mangle)]
pub extern "C" fn ask(payload: usize) -> usize {
    let mut bytes = QUESTION.take();
    let question = bytes.split_off(payload);
    told(crate::ask(&question, bytes, &mut |share| progress(share)).into_bytes())
}

fn told(answer: Vec<u8>) -> usize {
    let length = answer.len();
    ANSWER.set(answer);
    length
}

/// Where the answer is.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u8 {
    ANSWER.with_borrow(|answer| answer.as_ptr())
}
