// What is worked out of the robot when somebody asks: a GET request, asked again while
// too many others look inside.

const ATTEMPTS = 5;
const WAIT = 1000; // milliseconds, as the server has it

/** The answer of an address; one with `ok` false if there is none, or no server. */
export async function lookUp(address) {
  for (let attempt = 1; ; attempt += 1) {
    const answer = await fetch(address).catch(() => ({ ok: false }));
    if (answer.status !== 503 || attempt === ATTEMPTS) return answer;
    await new Promise((resolve) => setTimeout(resolve, WAIT * attempt));
  }
}
