//! The functions of the WebAssembly module.
//!
//! The caller allocates with `periplus_alloc`, writes there, and passes address and length; each of these functions
//! frees what it is passed. A function that can fail returns 0 and leaves its result in the answer, or 1 and leaves
//! the reason there, as text.
#![allow(unsafe_code, reason = "the caller passes addresses in the memory of the module")]

use std::cell::RefCell;
use std::fmt::Display;
use std::path::Path;
use std::sync::Once;
use std::time::Duration;

use periplus_os::fs;

use crate::calls::{TabCalls, with_messages};
use crate::files;
use crate::tab::{Tab, TabFrame};

#[link(wasm_import_module = "periplus")]
unsafe extern "C" {
    /// Time since 1970, which never jumps back \[ms\].
    safe fn clock_ms() -> f64;
    /// Reports the text of a panic, after which the module must not be used.
    fn panicked(text: *const u8, length: usize);
}

thread_local! {
    static TAB: RefCell<Option<Tab>> = const { RefCell::new(None) };
    static CALLS: RefCell<TabCalls> = RefCell::default();
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Without a session.
const NO_SESSION: &str = "there is no session; open one first";

fn prepare() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        periplus_os::set_clock(|| Duration::from_secs_f64(clock_ms().max(0.0) * 1e-3));
        std::panic::set_hook(Box::new(|info| {
            let text = info.to_string();
            // SAFETY: address and length of a string that lives during the call.
            unsafe { panicked(text.as_ptr(), text.len()) };
        }));
    });
}

/// Takes over what the caller has allocated.
fn passed(address: *mut u8, length: usize) -> Vec<u8> {
    if length == 0 {
        return Vec::new();
    }
    // SAFETY: by the rules of this module, `address` is from `periplus_alloc` with this length.
    unsafe { Vec::from_raw_parts(address, length, length) }
}

fn answer(result: Result<Vec<u8>, impl Display>) -> u32 {
    let (bytes, code) = match result {
        Ok(bytes) => (bytes, 0),
        Err(error) => (error.to_string().into_bytes(), 1),
    };
    ANSWER.with_borrow_mut(|answer| *answer = bytes);
    code
}

fn with_tab(work: impl FnOnce(&mut Tab) -> Result<Vec<u8>, String>) -> u32 {
    prepare();
    answer(TAB.with_borrow_mut(|tab| match tab {
        Some(tab) => work(tab),
        None => Err(NO_SESSION.to_owned()),
    }))
}

/// Allocates memory for an argument.
#[unsafe(no_mangle)]
pub extern "C" fn periplus_alloc(length: usize) -> *mut u8 {
    let mut bytes = vec![0_u8; length].into_boxed_slice();
    let address = bytes.as_mut_ptr();
    std::mem::forget(bytes);
    address
}

/// Address of the answer of the last function.
#[unsafe(no_mangle)]
pub extern "C" fn periplus_answer() -> *const u8 {
    ANSWER.with_borrow(|answer| answer.as_ptr())
}

/// Length of the answer of the last function \[bytes\].
#[unsafe(no_mangle)]
pub extern "C" fn periplus_answer_length() -> usize {
    ANSWER.with_borrow(Vec::len)
}

/// Starts a session from options in JSON; a session that runs is ended.
#[unsafe(no_mangle)]
pub extern "C" fn periplus_open(options: *mut u8, length: usize) -> u32 {
    prepare();
    let options = passed(options, length);
    TAB.with_borrow_mut(|tab| *tab = None);
    let opened = Tab::open_json(&options).map_err(|error| with_messages(&error.to_string()));
    answer(opened.map(|tab| {
        TAB.with_borrow_mut(|kept| *kept = Some(tab));
        Vec::new()
    }))
}

/// Ends the session.
#[unsafe(no_mangle)]
pub extern "C" fn periplus_close() {
    TAB.with_borrow_mut(|tab| *tab = None);
}

/// Steps until a simulated time \[ns\].
#[unsafe(no_mangle)]
pub extern "C" fn periplus_step_until(end_ns: i64) -> u32 {
    with_tab(|tab| tab.step_until(end_ns).map(|()| Vec::new()).map_err(|error| error.to_string()))
}

/// Simulated time \[ns\]; 0 without a session.
#[unsafe(no_mangle)]
pub extern "C" fn periplus_time_ns() -> i64 {
    TAB.with_borrow(|tab| tab.as_ref().map_or(0, Tab::time_ns))
}

/// Processes a JSON message of the client.
#[unsafe(no_mangle)]
pub extern "C" fn periplus_text(text: *mut u8, length: usize) -> u32 {
    let text = passed(text, length);
    with_tab(|tab| {
        let text = String::from_utf8(text).map_err(|_| "a text message is not UTF-8".to_owned())?;
        tab.text(&text);
        Ok(Vec::new())
    })
}

/// Processes a binary message of the client.
#[unsafe(no_mangle)]
pub extern "C" fn periplus_binary(bytes: *mut u8, length: usize) -> u32 {
    let bytes = passed(bytes, length);
    with_tab(|tab| {
        tab.binary(&bytes);
        Ok(Vec::new())
    })
}

/// Takes the next message to the client as the answer: returns 1 for JSON, 2 for a binary one, 3 for the reason of
/// the end, and 0 if there is none.
#[unsafe(no_mangle)]
pub extern "C" fn periplus_take() -> u32 {
    let frame = TAB.with_borrow(|tab| tab.as_ref().and_then(Tab::take));
    let (kind, bytes) = match frame {
        None => return 0,
        Some(TabFrame::Text(text)) => (1, text),
        Some(TabFrame::Binary(bytes)) => (2, bytes),
        Some(TabFrame::End(why)) => (3, why.into_bytes()),
    };
    ANSWER.with_borrow_mut(|answer| *answer = bytes);
    kind
}

/// Closes the recording.
#[unsafe(no_mangle)]
pub extern "C" fn periplus_close_recording() -> u32 {
    with_tab(|tab| tab.close_recording().map(|_| Vec::new()).map_err(|error| error.to_string()))
}

/// Reads a file in memory as the answer.
#[unsafe(no_mangle)]
pub extern "C" fn periplus_read_file(path: *mut u8, length: usize) -> u32 {
    let path = String::from_utf8_lossy(&passed(path, length)).into_owned();
    answer(fs::read(&path).map_err(|error| format!("`{path}`: {error}")))
}

/// Writes a file in memory, with its folders.
#[unsafe(no_mangle)]
pub extern "C" fn periplus_write_file(
    path: *mut u8,
    path_length: usize,
    content: *mut u8,
    length: usize,
) -> u32 {
    let path = String::from_utf8_lossy(&passed(path, path_length)).into_owned();
    let content = passed(content, length);
    let folder = Path::new(&path).parent().unwrap_or(Path::new("/"));
    let written = fs::create_dir_all(folder).and_then(|()| fs::write(&path, content));
    answer(written.map(|()| Vec::new()).map_err(|error| format!("`{path}`: {error}")))
}

/// Executes a call in JSON, such as a check of files, and leaves its answer; see [`crate::calls::TabCall`].
#[unsafe(no_mangle)]
pub extern "C" fn periplus_call(call: *mut u8, length: usize) -> u32 {
    prepare();
    let call = passed(call, length);
    let answered =
        TAB.with_borrow_mut(|tab| CALLS.with_borrow_mut(|calls| calls.answer(&call, tab.as_mut())));
    answer(answered.map_err(|error| with_messages(&error.to_string())))
}

/// Steps at the real-time factor of the world for at most this much wall time \[ms\]; the answer is the time until the
/// next step is due \[ms\], as eight bytes, little endian.
#[unsafe(no_mangle)]
pub extern "C" fn periplus_run_paced(budget_ms: f64) -> u32 {
    with_tab(|tab| {
        let budget =
            Duration::try_from_secs_f64(budget_ms.clamp(0.0, 1000.0) * 1e-3).unwrap_or_default();
        let wait = tab.run_paced(budget).map_err(|error| error.to_string())?;
        Ok((wait.as_secs_f64() * 1e3).to_le_bytes().to_vec())
    })
}

/// Lists the files in memory below a folder as the answer: a JSON list of objects with `path` and `bytes`.
#[unsafe(no_mangle)]
pub extern "C" fn periplus_list_files(folder: *mut u8, length: usize) -> u32 {
    let folder = String::from_utf8_lossy(&passed(folder, length)).into_owned();
    answer(files::list(Path::new(&folder)).map_err(|error| format!("`{folder}`: {error}")))
}

/// Removes a file in memory.
#[unsafe(no_mangle)]
pub extern "C" fn periplus_remove_file(path: *mut u8, length: usize) -> u32 {
    let path = String::from_utf8_lossy(&passed(path, length)).into_owned();
    answer(
        fs::remove_file(&path).map(|()| Vec::new()).map_err(|error| format!("`{path}`: {error}")),
    )
}
