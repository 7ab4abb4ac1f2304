// The worker that compares with the exact reference: the same program, asked by messages.
import init, { judge } from './cutaway_viewer.js';

const ready = init();
// A rejected promise is no error of the worker by itself, and the page would wait for an answer.
onunhandledrejection = (event) => reportError(event.reason);
onmessage = async (event) => {
  await ready;
  judge(event.data);
};
