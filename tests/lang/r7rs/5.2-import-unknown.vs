(import (only (scheme base) car box))   ; expect error: import: this library has no box
