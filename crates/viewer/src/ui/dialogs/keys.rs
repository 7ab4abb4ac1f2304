//! The table of keyboard shortcuts, with their effects and the help texts that `?` shows.

use cutaway::scene::STANDARD_VIEWS;
use eframe::egui::{Context, Key, KeyboardShortcut, Modifiers};

use crate::action::Action;
use crate::editing::cuts::PlaneMove;
use crate::picture::camera::CameraMove;
use crate::picture::slot::SlotLayout;

/// The effect of a key.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::ui) enum Does {
    /// An action of the state.
    Act(Action),
    /// Shows the table of keys, or hides it.
    Help,
    /// Copies the command for this picture to the clipboard.
    CopyCommand,
    /// Saves the scene.
    Save,
    /// Shows the second slot while the key is held.
    Flicker,
    /// Switches between perspective and parallel projection.
    Projection,
    /// Moves the plane through the face under the pointer.
    CutHere,
    /// Starts or pauses the animation.
    Play,
}

/// A key and its effect.
pub(in crate::ui) struct KeyBinding {
    /// The key, with its modifiers.
    pub(in crate::ui) key: KeyboardShortcut,
    /// The effect.
    pub(in crate::ui) does: Does,
    /// Help text.
    pub(in crate::ui) help: &'static str,
}

/// The key that shows the second slot while this key is held.
pub(in crate::ui) const FLICKER: Key = Key::B;

/// All keyboard shortcuts.
pub(in crate::ui) fn bindings() -> Vec<KeyBinding> {
    let key = |key, does, help| KeyBinding {
        key: KeyboardShortcut::new(Modifiers::NONE, key),
        does,
        help,
    };
    let command = |key, does, help| KeyBinding {
        key: KeyboardShortcut::new(Modifiers::COMMAND, key),
        does,
        help,
    };
    let act = Does::Act;
    let plane = |by| Does::Act(Action::MovePlane(by));
    let stand = |index: usize| {
        Does::Act(Action::MoveCamera(CameraMove::Stand(
            STANDARD_VIEWS[index].1,
        )))
    };
    vec![
        key(
            Key::X,
            plane(PlaneMove::Across(0)),
            "plane perpendicular to x; press again to keep the other side",
        ),
        key(
            Key::Y,
            plane(PlaneMove::Across(1)),
            "plane perpendicular to y; press again to keep the other side",
        ),
        key(
            Key::Z,
            plane(PlaneMove::Across(2)),
            "plane perpendicular to z; press again to keep the other side",
        ),
        key(Key::V, plane(PlaneMove::Flip), "keep the other side"),
        key(
            Key::OpenBracket,
            plane(PlaneMove::Step(-0.01)),
            "move the plane back by 1 %",
        ),
        key(
            Key::CloseBracket,
            plane(PlaneMove::Step(0.01)),
            "move the plane forward by 1 %",
        ),
        key(Key::C, act(Action::FaceEye), "turn the plane to face you"),
        key(
            Key::F,
            Does::CutHere,
            "move the plane through the face under the pointer",
        ),
        key(Key::Space, Does::Play, "play or pause"),
        key(Key::Num1, stand(0), "look from the front"),
        key(Key::Num3, stand(3), "look from the right"),
        key(Key::Num7, stand(4), "look from the top"),
        key(Key::Num5, Does::Projection, "perspective or parallel rays"),
        key(
            Key::Home,
            act(Action::MoveCamera(CameraMove::Home)),
            "show the whole model",
        ),
        key(
            Key::S,
            act(Action::Arrange(SlotLayout::Single)),
            "slot A alone",
        ),
        key(
            Key::W,
            act(Action::Arrange(SlotLayout::Wipe)),
            "wipe B over A",
        ),
        key(
            Key::D,
            act(Action::Arrange(SlotLayout::Difference)),
            "difference of A and B",
        ),
        key(FLICKER, Does::Flicker, "hold to show slot B instead of A"),
        key(Key::Questionmark, Does::Help, "show or hide these keys"),
        command(Key::Z, act(Action::Undo), "undo the last step"),
        command(Key::Y, act(Action::Redo), "redo the step"),
        command(Key::S, Does::Save, "save the scene"),
        KeyBinding {
            key: KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z),
            does: act(Action::Redo),
            help: "redo the step",
        },
        KeyBinding {
            key: KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::C),
            does: Does::CopyCommand,
            help: "copy the command that makes this picture",
        },
    ]
}

/// Effects of the keys pressed in this frame. Keys typed into a text field are ignored.
pub(in crate::ui) fn pressed(ctx: &Context) -> Vec<Does> {
    if ctx.egui_wants_keyboard_input() {
        return Vec::new();
    }
    let mut bound = bindings();
    // Bindings with the most modifiers first: a key press that one binding consumes is not seen by the others.
    bound.sort_by_key(|b| std::cmp::Reverse((b.key.modifiers.shift, b.key.modifiers.any())));
    let is_pressed = |b: &KeyBinding| ctx.input_mut(|input| input.consume_shortcut(&b.key));
    let pressed = bound.into_iter().filter(is_pressed);
    pressed.map(|b| b.does).collect()
}
