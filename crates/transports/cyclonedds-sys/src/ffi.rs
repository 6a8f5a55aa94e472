//! FFI declarations, equal to those of `c/shim.h`.
#![allow(clippy::missing_safety_doc, reason = "stated once for all below")]

use std::ffi::{CStr, c_char, c_void};
use std::sync::Once;

use crate::log;

#[repr(C)]
#[derive(Clone, Copy, Default)]
pub(crate) struct Identity {
    pub(crate) guid: [u8; 16],
    pub(crate) sequence: i64,
}

#[repr(C)]
#[derive(Clone, Copy, Default)]
pub(crate) struct Qos {
    pub(crate) deadline_ns: i64,
    pub(crate) lifespan_ns: i64,
    pub(crate) lease_ns: i64,
    pub(crate) blocking_ns: i64,
    pub(crate) reliability: i32,
    pub(crate) durability: i32,
    pub(crate) history: i32,
    pub(crate) depth: i32,
    pub(crate) liveliness: i32,
    pub(crate) unused: i32,
}

#[repr(C)]
pub(crate) struct Sample {
    pub(crate) bytes: *mut u8,
    pub(crate) size: usize,
    pub(crate) time_ns: i64,
    pub(crate) writer: Identity,
    pub(crate) related: Identity,
    pub(crate) vendor: [u8; 2],
    pub(crate) has_writer: u8,
    pub(crate) has_related: u8,
    pub(crate) is_data: u8,
    pub(crate) unused: [u8; 3],
}

#[repr(C)]
pub(crate) struct Found {
    pub(crate) loan: *mut c_void,
    pub(crate) topic: *mut c_char,
    pub(crate) type_name: *mut c_char,
    pub(crate) user_data: *mut u8,
    pub(crate) user_data_size: usize,
    pub(crate) qos: Qos,
    pub(crate) guid: [u8; 16],
    pub(crate) participant: [u8; 16],
    pub(crate) vendor: [u8; 2],
    pub(crate) is_alive: u8,
    pub(crate) unused: [u8; 5],
}

#[repr(C)]
struct Hooks {
    buffer_new: extern "C" fn(usize) -> *mut u8,
    buffer_free: unsafe extern "C" fn(*mut u8, usize),
    owner_free: unsafe extern "C" fn(*mut c_void),
    log: unsafe extern "C" fn(u32, *const c_char),
}

// All functions take entities by number, which Cyclone checks; pointers refer to live data of the
// adjacent size, or to one structure, and are not stored. The exception is `pp_write`, see there.
unsafe extern "C" {
    fn pp_size_of(which: i32) -> usize;
    fn pp_init(hooks: *const Hooks);
    pub(crate) fn pp_error(code: i32) -> *const c_char;
    pub(crate) fn pp_has_network() -> i32;
    pub(crate) fn pp_domain(id: u32, config: *const c_char) -> i32;
    pub(crate) fn pp_participant(domain: u32, user_data: *const u8, size: usize) -> i32;
    pub(crate) fn pp_topic(participant: i32, name: *const c_char, type_name: *const c_char) -> i32;
    pub(crate) fn pp_writer(
        participant: i32,
        topic: i32,
        qos: *const Qos,
        user_data: *const u8,
        size: usize,
    ) -> i32;
    pub(crate) fn pp_reader(
        participant: i32,
        topic: i32,
        qos: *const Qos,
        user_data: *const u8,
        size: usize,
    ) -> i32;
    pub(crate) fn pp_delete(entity: i32) -> i32;
    pub(crate) fn pp_guid(entity: i32, guid: *mut u8) -> i32;
    /// Reads the bytes until it passes `owner` to `owner_free`, from any thread.
    pub(crate) fn pp_write(
        writer: i32,
        bytes: *const u8,
        size: usize,
        owner: *mut c_void,
        related: *const Identity,
        waits: i32,
        sequence: *mut i64,
    ) -> i32;
    /// As `pp_write`, to the readers of the participant whose GUID begins with these 12 bytes.
    pub(crate) fn pp_send_to(
        writer: i32,
        bytes: *const u8,
        size: usize,
        owner: *mut c_void,
        related: *const Identity,
        prefix: *const u8,
        sequence: *mut i64,
    ) -> i32;
    pub(crate) fn pp_reaches(writer: i32, prefix: *const u8) -> i32;
    pub(crate) fn pp_take(reader: i32, sample: *mut Sample) -> i32;
    pub(crate) fn pp_assert_liveliness(writer: i32) -> i32;
    pub(crate) fn pp_wait_acknowledged(writer: i32, timeout_ns: i64) -> i32;
    pub(crate) fn pp_matched(endpoint: i32, is_writer: i32) -> i32;
    pub(crate) fn pp_discovery(participant: i32, kind: i32) -> i32;
    pub(crate) fn pp_discovery_take(reader: i32, kind: i32, found: *mut Found) -> i32;
    pub(crate) fn pp_discovery_return(reader: i32, found: *mut Found);
    pub(crate) fn pp_waitset(participant: i32) -> i32;
    pub(crate) fn pp_watch(waitset: i32, entity: i32, event: i32) -> i32;
    pub(crate) fn pp_wait(waitset: i32, entities: *mut isize, room: usize, timeout_ns: i64) -> i32;
    pub(crate) fn pp_guard(participant: i32) -> i32;
    pub(crate) fn pp_guard_set(guard: i32, on: i32) -> i32;
}

/// Allocates a buffer for received data as the memory of a vector, so that receiving copies
/// nothing. Null if memory is exhausted; then the sample is lost.
extern "C" fn buffer_new(size: usize) -> *mut u8 {
    let mut bytes: Vec<u8> = Vec::new();
    // An empty vector has no memory to pass to C.
    if bytes.try_reserve_exact(size.max(1)).is_err() {
        return std::ptr::null_mut();
    }
    std::mem::ManuallyDrop::new(bytes).as_mut_ptr()
}

/// Converts a buffer of [`buffer_new`] back to a vector.
///
/// # Safety
/// `bytes` is from `buffer_new(size)`, completely written, and not used elsewhere.
pub(crate) unsafe fn buffer(bytes: *mut u8, size: usize) -> Vec<u8> {
    // SAFETY: `try_reserve_exact` of an empty vector of bytes reserves exactly that size.
    unsafe { Vec::from_raw_parts(bytes, size, size.max(1)) }
}

unsafe extern "C" fn buffer_free(bytes: *mut u8, size: usize) {
    // SAFETY: C returns the buffer that it got. The bytes may be uninitialized; none is read.
    drop(unsafe { Vec::from_raw_parts(bytes, 0, size.max(1)) });
}

/// Owner of bytes that C holds.
pub(crate) type Owner = Box<dyn crate::Bytes>;

unsafe extern "C" fn owner_free(owner: *mut c_void) {
    // SAFETY: C returns, once, the box that `Writer::write` created.
    drop(unsafe { Box::from_raw(owner.cast::<Owner>()) });
}

unsafe extern "C" fn on_log(category: u32, text: *const c_char) {
    // SAFETY: Cyclone passes a string that ends with a zero.
    let text = unsafe { CStr::from_ptr(text) };
    log::note(category, &text.to_string_lossy());
}

/// Initializes the shim; called before anything else.
pub(crate) fn init() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let sizes =
            [size_of::<Identity>(), size_of::<Qos>(), size_of::<Sample>(), size_of::<Found>()];
        for (which, size) in (0..).zip(sizes) {
            // SAFETY: the function only returns a size.
            let there = unsafe { pp_size_of(which) };
            assert_eq!(size, there, "structure {which} of shim.h differs from that of ffi.rs");
        }
        let hooks = Hooks { buffer_new, buffer_free, owner_free, log: on_log };
        // SAFETY: the function copies its argument.
        unsafe { pp_init(&raw const hooks) };
    });
}
