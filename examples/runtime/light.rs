// The same in Rust: declarations of ssphh/runtime/runtime.h, a safe light over them, and a program.
//   rustc light.rs -L native=PREFIX/lib -l static=ssphh_runtime

use std::ffi::{c_char, c_int, c_uint, c_void, CStr};
use std::marker::PhantomData;

mod ffi {
    use super::*;

    #[repr(C)]
    pub struct Runtime {
        _private: [u8; 0],
    }

    #[repr(C)]
    #[derive(Clone, Copy)]
    pub struct Place {
        pub position: [f32; 3],
        pub normal: [f32; 3],
    }

    #[repr(C)]
    #[derive(Default)]
    pub struct Info {
        pub groups: u32,
        pub probes: u32,
        pub points: u32,
        pub has_sight: u32,
        pub time: f32,
        pub geometry: u64,
        pub scene: [u64; 2],
        pub light_bytes: u64,
    }

    #[repr(C)]
    #[allow(dead_code)]
    pub struct Group {
        pub name: *const c_char,
        pub scale: [f32; 3],
        pub baked: u32,
    }

    pub const OPEN: c_uint = 1;

    #[allow(dead_code)]
    extern "C" {
        pub fn ssphh_runtime_message(result: c_int) -> *const c_char;
        pub fn ssphh_runtime_size_needed(file: *const c_void, file_size: usize, memory_size: *mut usize) -> c_int;
        pub fn ssphh_runtime_open(
            file: *const c_void,
            file_size: usize,
            memory: *mut c_void,
            memory_size: usize,
            runtime: *mut *mut Runtime,
        ) -> c_int;
        pub fn ssphh_runtime_describe(runtime: *const Runtime, info: *mut Info) -> c_int;
        pub fn ssphh_runtime_describe_group(runtime: *const Runtime, group: u32, out: *mut Group) -> c_int;
        pub fn ssphh_runtime_set_group_scale(runtime: *mut Runtime, group: u32, scale: *const f32) -> c_int;
        pub fn ssphh_runtime_swap_light(runtime: *mut Runtime, file: *const c_void, file_size: usize) -> c_int;
        pub fn ssphh_runtime_irradiance(
            runtime: *const Runtime,
            flags: c_uint,
            position: *const f32,
            normal: *const f32,
            rgb: *mut f32,
        ) -> c_int;
        pub fn ssphh_runtime_irradiance_batch(
            runtime: *const Runtime,
            flags: c_uint,
            places: *const Place,
            count: usize,
            rgb: *mut f32,
        ) -> c_int;
    }
}

type Result<T> = std::result::Result<T, String>;

fn check(result: c_int) -> Result<()> {
    if result == 0 {
        return Ok(());
    }
    let message = unsafe { CStr::from_ptr(ffi::ssphh_runtime_message(result)) };
    Err(message.to_string_lossy().into_owned())
}

/// 16 bytes of a cooked file: a vector of them is aligned as the library wants it.
#[repr(C, align(16))]
#[derive(Clone, Copy)]
pub struct Block([u8; 16]);

/// An open file, which must outlive it.
pub struct Light<'a> {
    runtime: *mut ffi::Runtime,
    _memory: Vec<Block>,
    _file: PhantomData<&'a [Block]>,
}

impl<'a> Light<'a> {
    pub fn open(file: &'a [Block], size: usize) -> Result<Light<'a>> {
        assert!(size <= 16 * file.len());
        let (mut needed, mut runtime) = (0, std::ptr::null_mut());
        let data = file.as_ptr().cast();
        check(unsafe { ffi::ssphh_runtime_size_needed(data, size, &mut needed) })?;
        let mut memory = vec![Block([0; 16]); (needed + 15) / 16];
        check(unsafe { ffi::ssphh_runtime_open(data, size, memory.as_mut_ptr().cast(), needed, &mut runtime) })?;
        Ok(Light { runtime, _memory: memory, _file: PhantomData })
    }

    pub fn groups(&self) -> Result<u32> {
        let mut info = ffi::Info::default();
        check(unsafe { ffi::ssphh_runtime_describe(self.runtime, &mut info) })?;
        Ok(info.groups)
    }

    pub fn set_group_scale(&mut self, group: u32, scale: [f32; 3]) -> Result<()> {
        check(unsafe { ffi::ssphh_runtime_set_group_scale(self.runtime, group, scale.as_ptr()) })
    }

    pub fn irradiance(&self, position: [f32; 3], normal: [f32; 3]) -> Result<[f32; 3]> {
        let place = ffi::Place { position, normal };
        let mut rgb = [0.0; 3];
        check(unsafe { ffi::ssphh_runtime_irradiance_batch(self.runtime, ffi::OPEN, &place, 1, rgb.as_mut_ptr()) })?;
        Ok(rgb)
    }
}

fn main() -> Result<()> {
    let path = std::env::args().nth(1).ok_or("light FILE.sphlc")?;
    let bytes = std::fs::read(&path).map_err(|e| format!("{path}: {e}"))?;
    let mut file = vec![Block([0; 16]); (bytes.len() + 15) / 16];
    for (block, part) in file.iter_mut().zip(bytes.chunks(16)) {
        block.0[..part.len()].copy_from_slice(part);
    }
    let mut light = Light::open(&file, bytes.len())?;
    let groups = light.groups()?;
    println!("light groups: {groups}");
    for normal in [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]] {
        let [r, g, b] = light.irradiance([0.0, -0.5, 0.0], normal)?;
        println!("irradiance: {r:.1} {g:.1} {b:.1} W/m2");
    }
    for group in 0..groups {
        light.set_group_scale(group, [0.5; 3])?;
    }
    let [r, g, b] = light.irradiance([0.0, -0.5, 0.0], [0.0, -1.0, 0.0])?;
    println!("dimmed: {r:.2} {g:.2} {b:.2} W/m2");
    Ok(())
}
