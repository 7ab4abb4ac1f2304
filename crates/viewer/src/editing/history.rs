//! Undo and redo: earlier and later documents.
//!
//! A document is small, so a step stores the whole previous document with its text. Changes by one gesture, such as dragging a
//! slider, are one step. A move of the eye is not a step: after undoing a cut, its effect must stay in view.

use std::sync::Arc;

use cutaway_io::Document;

/// Maximum number of steps.
const MOST_STEPS: usize = 200;

/// Gesture that a change is part of: consecutive changes with the same gesture are one step.
pub type Gesture = String;

/// Documents for undo and redo.
#[derive(Clone, Debug, Default)]
pub struct History {
    past: Vec<Arc<Document>>,
    future: Vec<Arc<Document>>,
    gesture: Option<Gesture>,
}

impl History {
    /// Stores a document before it is changed, unless the change continues a gesture.
    pub fn keep(&mut self, before: &Document, gesture: Option<Gesture>) {
        let goes_on = gesture.is_some() && gesture == self.gesture;
        self.gesture = gesture;
        if goes_on {
            return;
        }
        self.future.clear();
        self.past.push(Arc::new(before.clone()));
        if self.past.len() > MOST_STEPS {
            self.past.remove(0);
        }
    }

    /// Ends the gesture: the next change is a separate step.
    pub fn end_gesture(&mut self) {
        self.gesture = None;
    }

    /// Goes one step back, and returns the earlier document.
    pub fn undo(&mut self, present: &Document) -> Option<Arc<Document>> {
        self.gesture = None;
        let before = self.past.pop()?;
        self.future.push(Arc::new(present.clone()));
        Some(before)
    }

    /// Goes one step forward, and returns the document whose change was undone.
    pub fn redo(&mut self, present: &Document) -> Option<Arc<Document>> {
        self.gesture = None;
        let after = self.future.pop()?;
        self.past.push(Arc::new(present.clone()));
        Some(after)
    }

    /// Whether there is a step to undo, and whether there is a step to redo.
    pub fn reaches(&self) -> [bool; 2] {
        [&self.past, &self.future].map(|steps| !steps.is_empty())
    }

    /// Clears all steps, before another document is opened.
    pub fn clear(&mut self) {
        *self = Self::default();
    }
}
