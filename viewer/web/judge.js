// The worker that compares with the exact reference: the same program, asked by messages.
import init, { judge } from './cutaway_viewer.js';

const ready = init();
onmessage = async (event) => {
  await ready;
  judge(event.data);
};
