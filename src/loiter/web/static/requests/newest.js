// @ts-check

/**
 * A queue of one: while a request is under way, only the newest of the following questions waits. So the service never
 * works on more than one state of a drag, and the last state always gets its answer.
 *
 * @template Question, Answer
 * @param {(question: Question) => Promise<Answer>} send
 * @param {(answer: Answer, question: Question) => void} answered
 * @param {(error: Error, question: Question) => void} failed
 * @returns {(question: Question) => void}
 */
export function newestOnly(send, answered, failed) {
  let busy = false;
  /** @type {{question: Question} | null} */
  let waiting = null;
  /** @param {Question} question */
  async function run(question) {
    busy = true;
    try {
      const answer = await send(question).catch((error) => failed(error, question));
      if (answer) answered(answer, question);
    } finally {
      busy = false;
      const next = waiting;
      waiting = null;
      if (next) run(next.question);
    }
  }
  return (question) => {
    if (busy) waiting = { question };
    else run(question);
  };
}
