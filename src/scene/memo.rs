//! Cache of results, keyed by the inputs that they were computed from.
//!
//! A lookup compares the key with each entry: caches hold the few inputs of recent frames or of one document. Shared data is compared by
//! identity ([`ById`]), which costs a pointer and never reads a mesh.

use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Shared data, compared by identity: equal if both are the same allocation.
pub struct ById<T>(pub Arc<T>);

impl<T> ById<T> {
    /// Identity of optional data.
    pub fn of(shared: Option<&Arc<T>>) -> Option<Self> {
        shared.map(|shared| Self(Arc::clone(shared)))
    }
}

/// Returns true if both are the same allocation, or both are absent; contents are not compared.
pub fn is_same<T>(a: Option<&Arc<T>>, b: Option<&Arc<T>>) -> bool {
    a.map(Arc::as_ptr) == b.map(Arc::as_ptr)
}

impl<T> Clone for ById<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<T> PartialEq for ById<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl<T> Eq for ById<T> {}

impl<T> fmt::Debug for ById<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:p}", Arc::as_ptr(&self.0))
    }
}

/// Cache of results. Without a stated capacity nothing is discarded.
pub struct Memo<K, V> {
    capacity: usize,
    /// Ordered by last request, the most recent last.
    entries: Mutex<Vec<(K, V)>>,
}

impl<K: PartialEq, V: Clone> Memo<K, V> {
    /// A cache of the `capacity` most recently requested results.
    pub const fn with_capacity(capacity: usize) -> Self {
        Self {
            capacity,
            entries: Mutex::new(Vec::new()),
        }
    }

    /// The result for a key, if it is cached.
    pub fn get(&self, key: &K) -> Option<V> {
        Self::find(&mut self.lock(), key)
    }

    /// Stores a result in place of the least recently requested one.
    pub fn insert(&self, key: K, value: V) {
        self.store(&mut self.lock(), key, value);
    }

    /// The result for a key: the cached one, otherwise that of `make`. Concurrent calls wait, so that each result is computed once.
    pub fn get_or_make(&self, key: K, make: impl FnOnce(&K) -> V) -> V {
        let made = self.get_or_try_make(key, |key| Ok::<_, std::convert::Infallible>(make(key)));
        made.unwrap_or_else(|never| match never {})
    }

    /// Like [`Self::get_or_make`]; errors are returned and not cached.
    ///
    /// # Errors
    ///
    /// Those of `make`.
    pub fn get_or_try_make<E>(
        &self,
        key: K,
        make: impl FnOnce(&K) -> Result<V, E>,
    ) -> Result<V, E> {
        let mut entries = self.lock();
        if let Some(known) = Self::find(&mut entries, &key) {
            return Ok(known);
        }
        let value = make(&key)?;
        self.store(&mut entries, key, value.clone());
        Ok(value)
    }

    fn lock(&self) -> MutexGuard<'_, Vec<(K, V)>> {
        self.entries.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn find(entries: &mut Vec<(K, V)>, key: &K) -> Option<V> {
        let at = entries.iter().position(|(known, _)| known == key)?;
        let latest = entries.remove(at);
        let value = latest.1.clone();
        entries.push(latest);
        Some(value)
    }

    fn store(&self, entries: &mut Vec<(K, V)>, key: K, value: V) {
        entries.retain(|(known, _)| *known != key);
        if entries.len() >= self.capacity {
            entries.remove(0);
        }
        entries.push((key, value));
    }
}

impl<K: PartialEq, V: Clone> Default for Memo<K, V> {
    fn default() -> Self {
        Self::with_capacity(usize::MAX)
    }
}

impl<K, V> fmt::Debug for Memo<K, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Memo").finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_is_computed_once_until_it_is_the_least_recent() {
        let memo = Memo::with_capacity(2);
        let mut made = Vec::new();
        let mut of = |key: u32| {
            memo.get_or_make(key, |key| {
                made.push(*key);
                key * 10
            })
        };
        assert_eq!([1, 2, 1, 3, 1, 2].map(&mut of), [10, 20, 10, 30, 10, 20]);
        assert_eq!(made, [1, 2, 3, 2]);
    }

    #[test]
    fn errors_are_not_cached() {
        let memo: Memo<u32, u32> = Memo::default();
        assert_eq!(memo.get_or_try_make(1, |_| Err("no")), Err("no"));
        assert_eq!(memo.get_or_try_make(1, |_| Ok::<_, &str>(7)), Ok(7));
        assert_eq!(memo.get(&1), Some(7));
    }

    #[test]
    fn shared_data_is_compared_by_identity() {
        let [a, b] = [Arc::new(1), Arc::new(1)];
        assert_eq!(ById(a.clone()), ById(a.clone()));
        assert_ne!(ById(a), ById(b));
    }
}
