//! The latest question of a kind to the judge: sent once per subject, and identified by its number.

/// The last question sent; only its answer counts.
#[derive(Debug)]
pub(super) struct Latest<T> {
    /// The number of the question; 0 before the first.
    id: u64,
    about: Option<T>,
}

impl<T> Default for Latest<T> {
    fn default() -> Self {
        Self { id: 0, about: None }
    }
}

impl<T: PartialEq> Latest<T> {
    /// The number of a new question, if its subject differs from the last one's.
    pub(super) fn ask(&mut self, about: T) -> Option<u64> {
        if self.about.as_ref() == Some(&about) {
            return None;
        }
        self.about = Some(about);
        self.id += 1;
        Some(self.id)
    }

    /// The number of the last question.
    pub(super) fn id(&self) -> u64 {
        self.id
    }

    /// Subject of the last question.
    pub(super) fn about(&self) -> Option<&T> {
        self.about.as_ref()
    }

    /// Forces the next question to be sent, whatever its subject. The last one counts until then.
    pub(super) fn forget(&mut self) {
        self.about = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_is_asked_once_unless_it_is_forgotten() {
        let mut latest = Latest::default();
        assert_eq!(latest.ask("a"), Some(1));
        assert_eq!(latest.ask("a"), None);
        assert_eq!(latest.ask("b"), Some(2));
        latest.forget();
        assert_eq!((latest.id(), latest.about()), (2, None));
        assert_eq!(latest.ask("b"), Some(3));
    }
}
