"""Other systems that solve y'' = S(x) y, each as one long-lived process, and an independent check of what they answer."""
