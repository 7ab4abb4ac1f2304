// The worker that compares pictures with the exact reference: the same program, driven by messages.
import init, { judge } from './cutaway_viewer.js';

const ready = init();
// A rejected promise alone is not reported to the page as an error, and the page would wait for an answer for ever.
onunhandledrejection = (event) => reportError(event.reason);
onmessage = async (event) => {
  await ready;
  judge(event.data);
};
