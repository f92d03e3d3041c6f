//! Working memory used again.
//!
//! A kernel that runs hundreds of times a second would spend as long on fetching fresh pages from
//! the system as on the arithmetic.

use std::ops::{Deref, DerefMut};
use std::sync::{Mutex, MutexGuard, PoisonError};

use pilotage_fourier::Complex32;

/// Buffers of one type kept at most.
const KEPT: usize = 24;
/// Longer buffers go back to the system.
const LONGEST: usize = 1 << 21;

/// Type of the elements of buffers.
pub(super) trait BufferElement: Copy + Default + 'static {
    /// The buffers at rest.
    fn pool() -> &'static Mutex<Vec<Vec<Self>>>;
}

macro_rules! element {
    ($($type:ty),*) => {$(
        impl BufferElement for $type {
            fn pool() -> &'static Mutex<Vec<Vec<Self>>> {
                static POOL: Mutex<Vec<Vec<$type>>> = Mutex::new(Vec::new());
                &POOL
            }
        }
    )*};
}
element!(f32, f64, Complex32);

fn lock<T: BufferElement>() -> MutexGuard<'static, Vec<Vec<T>>> {
    // Buffers have no state that a panic could break.
    T::pool().lock().unwrap_or_else(PoisonError::into_inner)
}

/// A buffer that returns to the pool when it is dropped.
#[derive(Debug)]
pub(super) struct Buffer<T: BufferElement>(Vec<T>);

impl<T: BufferElement> Buffer<T> {
    /// `length` zeros.
    pub fn zeros(length: usize) -> Self {
        let mut buffer = Self::with_capacity(length);
        buffer.0.clear();
        buffer.0.resize(length, T::default());
        buffer
    }

    /// `length` numbers of whatever value.
    pub fn dirty(length: usize) -> Self {
        let mut buffer = Self::with_capacity(length);
        buffer.0.resize(length, T::default());
        buffer
    }

    fn with_capacity(length: usize) -> Self {
        let mut pool = lock::<T>();
        // The smallest that is large enough.
        let fitting = (0..pool.len())
            .filter(|&i| pool[i].capacity() >= length)
            .min_by_key(|&i| pool[i].capacity());
        Self(fitting.map_or_else(|| Vec::with_capacity(length), |i| pool.swap_remove(i)))
    }
}

impl<T: BufferElement> Drop for Buffer<T> {
    fn drop(&mut self) {
        if self.0.capacity() > LONGEST {
            return;
        }
        let mut pool = lock::<T>();
        pool.push(std::mem::take(&mut self.0));
        if pool.len() > KEPT {
            let smallest = (0..pool.len()).min_by_key(|&i| pool[i].capacity());
            if let Some(smallest) = smallest {
                pool.swap_remove(smallest);
            }
        }
    }
}

impl<T: BufferElement> Clone for Buffer<T> {
    fn clone(&self) -> Self {
        let mut copy = Self::dirty(self.0.len());
        copy.copy_from_slice(self);
        copy
    }
}

impl<T: BufferElement> Deref for Buffer<T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T: BufferElement> DerefMut for Buffer<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.0
    }
}
