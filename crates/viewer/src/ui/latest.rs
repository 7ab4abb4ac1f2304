//! Numbers the questions of one kind to the judge, so that each subject is asked about once and only the latest question's answer counts.

/// The latest question; answers to earlier ones are ignored.
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
    /// The number of a new question; `None` if its subject is that of the last question.
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

    /// Makes the next question be sent even if its subject is the same. Until then the last question's answer still counts.
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
