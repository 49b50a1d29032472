"""The page: the robot in a browser, to be taught and looked into.

The robot has a thread of its own, in which its turns are taken one after another; it
tells what happens as events with numbers, and waits for no browser. Whoever looks at
the page is sent the events after the last one that they have, and the newest picture.

| module | has |
| --- | --- |
| `feed` | the events in order, for whoever comes or comes back |
| `live_picture` | the robot's sensor, whose frames are shown |
| `robot_thread` | the robot, and whose turn it is |
| `turn_reports` | turns and views as JSON |
| `table` | the table from above, arranged by hand; recordings, wound by hand |
| `state_changes` | what a turn did to the information state, when somebody asks |
| `unfired_rules` | the rules that did not fire in a turn, and why |
| `word_shelf` | words with their examples, and what was learned from them |
| `stepping` | turns that wait before each rule |
| `second_robot` | a robot of another theory, which lives through the same |
| `side_by_side` | what the two made of a turn, with what differs marked |
| `history` | pictures and events of earlier turns |
| `exports` | a turn or the dialogue as a file |
| `lookup_routes` | the addresses at which it is looked into |
| `browser_requests` | what a browser may ask for, checked |
| `guard` | who may reach the page: hosts, origins, tokens; and safe headers |
| `certificates` | the certificate of this host, for TLS |
| `microphone`, `spoken_answers` | whose microphone is heard; the robot's voice |
| `app`, `server` | the page over HTTP and WebSocket, and its process |
| `assets/` | the page itself: HTML, CSS and modules of JavaScript as they are written |
"""
