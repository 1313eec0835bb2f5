//! How the page calls: it writes the question into memory, asks, and reads the answer.
//!
//! The functions are exported by their names, which the lint counts as unsafe; nothing else here is.
#![allow(unsafe_code)]

use std::cell::RefCell;

thread_local! {
    static QUESTION: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    #[cfg(feature = "studio")]
    static PAYLOAD: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static NUMBERS: RefCell<Vec<f64>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<String> = const { RefCell::new(String::new()) };
}

#[cfg(feature = "studio")]
unsafe extern "C" {
    /// The page is told the share of the work that is done.
    safe fn progress(share: f64);
}

/// Where a question of so many bytes is to be written.
#[unsafe(no_mangle)]
pub extern "C" fn question(length: usize) -> *mut u8 {
    QUESTION.with_borrow_mut(|bytes| room(bytes, length))
}

/// Where a payload of so many bytes is to be written; null if there is no room.
#[cfg(feature = "studio")]
#[unsafe(no_mangle)]
pub extern "C" fn payload(length: usize) -> *mut u8 {
    PAYLOAD.with_borrow_mut(|bytes| room(bytes, length))
}

/// Answers the question with what is shown of a scene; the answer has so many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn view() -> usize {
    let (answer, numbers) = QUESTION.with_borrow(|question| crate::view(question));
    NUMBERS.set(numbers);
    told(answer)
}

/// Has the scene in the question a curve?
#[unsafe(no_mangle)]
pub extern "C" fn allowed() -> bool {
    QUESTION.with_borrow(|question| crate::allowed(question))
}

/// Answers any other question, with its payload.
#[cfg(feature = "studio")]
#[unsafe(no_mangle)]
pub extern "C" fn ask() -> usize {
    let payload = PAYLOAD.take();
    told(
        QUESTION
            .with_borrow(|question| crate::ask(question, payload, &mut |share| progress(share))),
    )
}

fn told(answer: String) -> usize {
    let length = answer.len();
    ANSWER.set(answer);
    length
}

/// Where the answer is.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u8 {
    ANSWER.with_borrow(|answer| answer.as_ptr())
}

/// Where the numbers of a view are.
#[unsafe(no_mangle)]
pub extern "C" fn numbers() -> *const f64 {
    NUMBERS.with_borrow(|numbers| numbers.as_ptr())
}

fn room(bytes: &mut Vec<u8>, length: usize) -> *mut u8 {
    bytes.clear();
    if bytes.try_reserve_exact(length).is_err() {
        return std::ptr::null_mut();
    }
    bytes.resize(length, 0);
    bytes.as_mut_ptr()
}
